// Indices that say what they count, and vectors and matrices that are indexed by nothing else.
// Accesses are checked where NDEBUG is not defined. Always inline: the step loop is compiled for
// several instruction sets, and none may lend its code to another.
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace linkstudy {

// A number from 0 on, or none. Indices of two tags are two types.
template <class Tag>
class TypedIndex {
 public:
  // None.
  [[gnu::always_inline]] constexpr TypedIndex() : value_(-1) {}
  template <std::integral Number>
  [[gnu::always_inline]] explicit constexpr TypedIndex(Number value)
      : value_(static_cast<int>(value)) {}

  [[gnu::always_inline]] constexpr int value() const { return value_; }
  [[gnu::always_inline]] constexpr bool exists() const { return value_ >= 0; }

  [[gnu::always_inline]] constexpr TypedIndex& operator++() {
    ++value_;
    return *this;
  }
  [[gnu::always_inline]] constexpr TypedIndex& operator+=(int steps) {
    value_ += steps;
    return *this;
  }

  [[gnu::always_inline]] friend constexpr TypedIndex operator+(TypedIndex i, int steps) {
    return TypedIndex(i.value_ + steps);
  }
  [[gnu::always_inline]] friend constexpr TypedIndex operator-(TypedIndex i, int steps) {
    return TypedIndex(i.value_ - steps);
  }
  [[gnu::always_inline]] friend constexpr int operator-(TypedIndex a, TypedIndex b) {
    return a.value_ - b.value_;
  }

  [[gnu::always_inline]] friend constexpr bool operator==(TypedIndex a, TypedIndex b) {
    return a.value_ == b.value_;
  }
  [[gnu::always_inline]] friend constexpr bool operator<(TypedIndex a, TypedIndex b) {
    return a.value_ < b.value_;
  }
  [[gnu::always_inline]] friend constexpr bool operator>(TypedIndex a, TypedIndex b) {
    return a.value_ > b.value_;
  }
  [[gnu::always_inline]] friend constexpr bool operator<=(TypedIndex a, TypedIndex b) {
    return a.value_ <= b.value_;
  }
  [[gnu::always_inline]] friend constexpr bool operator>=(TypedIndex a, TypedIndex b) {
    return a.value_ >= b.value_;
  }

 private:
  int value_;
};

template <class Index, class T>
class IndexedVector : public std::vector<T> {
 public:
  using Base = std::vector<T>;
  using IndexType = Index;
  using Base::Base;

  [[gnu::always_inline]] T& operator[](Index i) {
    assert(holds(i));
    return this->data()[i.value()];
  }
  [[gnu::always_inline]] const T& operator[](Index i) const {
    assert(holds(i));
    return this->data()[i.value()];
  }

  [[gnu::always_inline]] bool holds(Index i) const { return i.exists() && i < end_index(); }
  // One past the last; that of what is appended next.
  [[gnu::always_inline]] Index end_index() const { return Index(this->size()); }
};

// Items in a row whose number is not known here: accesses are not checked.
template <class Index, class T>
class IndexedPointer {
 public:
  [[gnu::always_inline]] constexpr IndexedPointer(T* first) : first_(first) {}
  template <class Other>
  requires std::is_same_v<const Other, T>
  [[gnu::always_inline]] constexpr IndexedPointer(IndexedPointer<Index, Other> other)
      : first_(other.data()) {}
  template <class V>
  requires std::is_same_v<typename V::IndexType, Index> &&
      std::is_convertible_v<decltype(std::declval<V&>().data()), T*>
  [[gnu::always_inline]] constexpr IndexedPointer(V& vector) : first_(vector.data()) {}

  [[gnu::always_inline]] constexpr T& operator[](Index i) const { return first_[i.value()]; }
  [[gnu::always_inline]] constexpr T* data() const { return first_; }

 private:
  T* first_;
};

// A matrix row by row, not owned.
template <class RowIndex, class ColumnIndex, class T>
class IndexedMatrixView {
 public:
  using value_type = std::remove_const_t<T>;

  [[gnu::always_inline]] constexpr IndexedMatrixView(T* first, int columns)
      : first_(first), columns_(columns) {}

  [[gnu::always_inline]] constexpr T& operator()(RowIndex r, ColumnIndex k) const {
    assert(r.exists() && k.exists() && k.value() < columns_);
    return first_[r.value() * columns_ + k.value()];
  }
  [[gnu::always_inline]] constexpr IndexedPointer<ColumnIndex, T> row(RowIndex r) const {
    return first_ + r.value() * columns_;
  }

 private:
  T* first_;
  int columns_;
};

// A matrix row by row.
template <class RowIndex, class ColumnIndex, class T>
class IndexedMatrix {
 public:
  using value_type = T;

  IndexedMatrix() = default;
  IndexedMatrix(std::size_t rows, std::size_t columns, const T& value)
      : items_(rows * columns, value), columns_(static_cast<int>(columns)) {}

  [[gnu::always_inline]] T& operator()(RowIndex r, ColumnIndex k) {
    assert(holds(r, k));
    return view()(r, k);
  }
  [[gnu::always_inline]] const T& operator()(RowIndex r, ColumnIndex k) const {
    assert(holds(r, k));
    return view()(r, k);
  }
  [[gnu::always_inline]] IndexedPointer<ColumnIndex, T> row(RowIndex r) { return view().row(r); }
  [[gnu::always_inline]] IndexedPointer<ColumnIndex, const T> row(RowIndex r) const {
    return view().row(r);
  }

  [[gnu::always_inline]] IndexedMatrixView<RowIndex, ColumnIndex, T> view() {
    return {items_.data(), columns_};
  }
  [[gnu::always_inline]] IndexedMatrixView<RowIndex, ColumnIndex, const T> view() const {
    return {items_.data(), columns_};
  }

  [[gnu::always_inline]] T* data() { return items_.data(); }
  [[gnu::always_inline]] const T* data() const { return items_.data(); }
  [[gnu::always_inline]] std::size_t size() const { return items_.size(); }

 private:
  [[gnu::always_inline]] bool holds(RowIndex r, ColumnIndex k) const {
    return r.exists() && k.exists() && k.value() < columns_ &&
           r.value() * columns_ + k.value() < static_cast<int>(items_.size());
  }

  std::vector<T> items_;
  int columns_ = 0;
};

}  // namespace linkstudy
