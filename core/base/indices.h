// Loops over indices, for range-based `for`: `for (const int i : indices(n))`. Always inline: the
// step loop is compiled for several instruction sets, and none may lend its code to another.
#pragma once

#include "core/base/typed_index.h"

namespace linkstudy {

// The number of an index, which is an int or a TypedIndex.
[[gnu::always_inline]] constexpr int number_of(int i) {
  return i;
}
template <class Tag>
[[gnu::always_inline]] constexpr int number_of(TypedIndex<Tag> i) {
  return i.value();
}

// What a range-based `for` asks for: from `first` by steps of `Step` until `last` is met.
template <class Index, int Step>
class IndexRange {
 public:
  class Iterator {
   public:
    [[gnu::always_inline]] explicit constexpr Iterator(Index i) : i_(i) {}
    [[gnu::always_inline]] constexpr Index operator*() const { return i_; }
    [[gnu::always_inline]] constexpr void operator++() { i_ += Step; }
    [[gnu::always_inline]] constexpr bool operator!=(Iterator end) const { return !(i_ == end.i_); }

   private:
    Index i_;
  };

  [[gnu::always_inline]] constexpr IndexRange(Index first, Index last)
      : first_(first), last_(last) {}
  [[gnu::always_inline]] constexpr Iterator begin() const { return Iterator(first_); }
  [[gnu::always_inline]] constexpr Iterator end() const { return Iterator(last_); }

 private:
  Index first_, last_;
};

// begin, begin + 1, ..., end - 1; none if end <= begin.
[[gnu::always_inline]] constexpr IndexRange<int, 1> indices(int begin, int end) {
  return {begin, end < begin ? begin : end};
}
template <class Tag>
[[gnu::always_inline]] constexpr IndexRange<TypedIndex<Tag>, 1> indices(TypedIndex<Tag> begin,
                                                                        TypedIndex<Tag> end) {
  return {begin, end < begin ? begin : end};
}
[[gnu::always_inline]] constexpr IndexRange<int, 1> indices(int end) {
  return indices(0, end);
}
template <class Tag>
[[gnu::always_inline]] constexpr IndexRange<TypedIndex<Tag>, 1> indices(TypedIndex<Tag> end) {
  return indices(TypedIndex<Tag>(0), end);
}

// end - 1, ..., begin
[[gnu::always_inline]] constexpr IndexRange<int, -1> indices_down(int begin, int end) {
  return {(end < begin ? begin : end) - 1, begin - 1};
}
template <class Tag>
[[gnu::always_inline]] constexpr IndexRange<TypedIndex<Tag>, -1> indices_down(TypedIndex<Tag> begin,
                                                                              TypedIndex<Tag> end) {
  return {(end < begin ? begin : end) - 1, begin - 1};
}
[[gnu::always_inline]] constexpr IndexRange<int, -1> indices_down(int end) {
  return indices_down(0, end);
}
template <class Tag>
[[gnu::always_inline]] constexpr IndexRange<TypedIndex<Tag>, -1> indices_down(TypedIndex<Tag> end) {
  return indices_down(TypedIndex<Tag>(0), end);
}

// Of all items of a container, by what it is indexed by.
template <class A>
[[gnu::always_inline]] constexpr auto end_index_of(const A& a) {
  if constexpr (requires { a.end_index(); }) {
    return a.end_index();
  } else {
    return static_cast<int>(a.size());
  }
}
template <class A>
[[gnu::always_inline]] constexpr auto indices_of(const A& a) {
  return indices(end_index_of(a));
}
template <class A>
[[gnu::always_inline]] constexpr auto indices_down_of(const A& a) {
  return indices_down(end_index_of(a));
}

// k, parent[k], ... as long as the index is not below `root`.
template <class Index, class Parent>
class PathRange {
 public:
  struct End {};
  class Iterator {
   public:
    [[gnu::always_inline]] constexpr Iterator(Index i, Index root, Parent parent)
        : i_(i), root_(root), parent_(parent) {}
    [[gnu::always_inline]] constexpr Index operator*() const { return i_; }
    [[gnu::always_inline]] constexpr void operator++() { i_ = parent_(i_); }
    [[gnu::always_inline]] constexpr bool operator!=(End) const { return i_ >= root_; }

   private:
    Index i_, root_;
    Parent parent_;
  };

  [[gnu::always_inline]] constexpr PathRange(Index first, Index root, Parent parent)
      : first_(first), root_(root), parent_(parent) {}
  [[gnu::always_inline]] constexpr Iterator begin() const { return {first_, root_, parent_}; }
  [[gnu::always_inline]] constexpr End end() const { return {}; }

 private:
  Index first_, root_;
  Parent parent_;
};

// A tree of velocities has v_parent: v_parent[k] < k is the next ancestor of k, or none.
template <class Tree, class Index>
[[gnu::always_inline]] inline auto path(const Tree& tree, Index k) {
  return PathRange(k, Index(0),
                   [parent = tree.v_parent.data()](Index i) { return parent[number_of(i)]; });
}
template <class Tree, class Index>
[[gnu::always_inline]] inline auto ancestors(const Tree& tree, Index k) {
  return path(tree, tree.v_parent.data()[number_of(k)]);
}
template <class Tree>
[[gnu::always_inline]] inline auto velocities(const Tree& tree) {
  return indices_of(tree.v_parent);
}
template <class Tree>
[[gnu::always_inline]] inline auto velocities_down(const Tree& tree) {
  return indices_down_of(tree.v_parent);
}

}  // namespace linkstudy
