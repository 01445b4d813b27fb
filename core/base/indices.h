// Loops over indices, for range-based `for`: `for (const int i : indices(n))`. Always inline: the
// step loop is compiled for several instruction sets, and none may lend its code to another.
#pragma once

#include <vector>

namespace linkstudy {

// a[i], unchecked.
template <class A>
[[gnu::always_inline]] constexpr auto& at(A& a, int i) {
  return a.data()[i];
}

// What a range-based `for` asks for: from `first` by steps of `Step` until `last` is met.
template <int Step>
class IndexRange {
 public:
  class Iterator {
   public:
    [[gnu::always_inline]] explicit constexpr Iterator(int i) : i_(i) {}
    [[gnu::always_inline]] constexpr int operator*() const { return i_; }
    [[gnu::always_inline]] constexpr void operator++() { i_ += Step; }
    [[gnu::always_inline]] constexpr bool operator!=(Iterator end) const { return i_ != end.i_; }

   private:
    int i_;
  };

  [[gnu::always_inline]] constexpr IndexRange(int first, int last) : first_(first), last_(last) {}
  [[gnu::always_inline]] constexpr Iterator begin() const { return Iterator(first_); }
  [[gnu::always_inline]] constexpr Iterator end() const { return Iterator(last_); }

 private:
  int first_, last_;
};

// begin, begin + 1, ..., end - 1; none if end <= begin.
[[gnu::always_inline]] constexpr IndexRange<1> indices(int begin, int end) {
  return {begin, end < begin ? begin : end};
}
[[gnu::always_inline]] constexpr IndexRange<1> indices(int end) {
  return indices(0, end);
}

// Of all items of a container.
template <class A>
[[gnu::always_inline]] constexpr IndexRange<1> indices_of(const A& a) {
  return {0, static_cast<int>(a.size())};
}

// end - 1, ..., begin
[[gnu::always_inline]] constexpr IndexRange<-1> indices_down(int begin, int end) {
  return {(end < begin ? begin : end) - 1, begin - 1};
}
[[gnu::always_inline]] constexpr IndexRange<-1> indices_down(int end) {
  return indices_down(0, end);
}

// k, parent[k], ... as long as the index is not below `root`.
template <class Parent>
class PathRange {
 public:
  struct End {};
  class Iterator {
   public:
    [[gnu::always_inline]] constexpr Iterator(int i, int root, Parent parent)
        : i_(i), root_(root), parent_(parent) {}
    [[gnu::always_inline]] constexpr int operator*() const { return i_; }
    [[gnu::always_inline]] constexpr void operator++() { i_ = parent_(i_); }
    [[gnu::always_inline]] constexpr bool operator!=(End) const { return i_ >= root_; }

   private:
    int i_, root_;
    Parent parent_;
  };

  [[gnu::always_inline]] constexpr PathRange(int first, int root, Parent parent)
      : first_(first), root_(root), parent_(parent) {}
  [[gnu::always_inline]] constexpr Iterator begin() const { return {first_, root_, parent_}; }
  [[gnu::always_inline]] constexpr End end() const { return {}; }

 private:
  int first_, root_;
  Parent parent_;
};

// A tree of velocities has nv and v_parent: v_parent[k] < k is the next ancestor of k, or -1.
template <class Tree>
[[gnu::always_inline]] inline auto path(const Tree& tree, int k) {
  return PathRange(k, 0, [parent = tree.v_parent.data()](int i) { return parent[i]; });
}
template <class Tree>
[[gnu::always_inline]] inline auto ancestors(const Tree& tree, int k) {
  return path(tree, at(tree.v_parent, k));
}
template <class Tree>
[[gnu::always_inline]] inline auto velocities(const Tree& tree) {
  return indices(tree.nv);
}
template <class Tree>
[[gnu::always_inline]] inline auto velocities_down(const Tree& tree) {
  return indices_down(tree.nv);
}

}  // namespace linkstudy
