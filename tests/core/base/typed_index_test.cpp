// Indices that say what they count, and what is indexed by them.
#include "core/base/typed_index.h"

#include <gmock/gmock.h>

#include "core/base/indices.h"

namespace linkstudy::testing::typed_index_test {
namespace {

using ::testing::ElementsAre;

using Dog = TypedIndex<struct DogTag>;
using Cat = TypedIndex<struct CatTag>;
using Dogs = IndexedVector<Dog, double>;
using Scratches = IndexedMatrix<Cat, Dog, double>;

template <class Range>
std::vector<int> numbers_in(const Range& range) {
  std::vector<int> numbers;
  for (const auto i : range) numbers.push_back(i.value());
  return numbers;
}

template <class Items, class Index>
concept Takes = requires(Items items, Index i) {
  items[i];
};
template <class Matrix, class Row, class Column>
concept TakesBoth = requires(Matrix m, Row r, Column k) {
  m(r, k);
};
template <class A, class B>
concept Compares = requires(A a, B b) {
  a == b;
}
|| requires(A a, B b) {
  a < b;
};
template <class A, class B>
concept Subtracts = requires(A a, B b) {
  a - b;
};

// An index is as cheap as its number.
static_assert(std::is_trivially_copyable_v<Dog> && sizeof(Dog) == sizeof(int));

// Types do not mix.
static_assert(Takes<Dogs, Dog> && Takes<const Dogs, Dog>);
static_assert(!Takes<Dogs, Cat> && !Takes<Dogs, int> && !Takes<Dogs, std::size_t>);
static_assert(Takes<IndexedPointer<Dog, double>, Dog>);
static_assert(!Takes<IndexedPointer<Dog, double>, Cat> && !Takes<IndexedPointer<Dog, double>, int>);
static_assert(TakesBoth<Scratches, Cat, Dog>);
static_assert(!TakesBoth<Scratches, Dog, Cat> && !TakesBoth<Scratches, int, int>);
static_assert(Compares<Dog, Dog> && !Compares<Dog, Cat> && !Compares<Dog, int>);
static_assert(Subtracts<Dog, Dog> && Subtracts<Dog, int> && !Subtracts<Dog, Cat>);
static_assert(!std::is_convertible_v<int, Dog> && !std::is_convertible_v<Dog, int>);
static_assert(!std::is_constructible_v<Dog, Cat>);
static_assert(std::is_convertible_v<Dogs&, IndexedPointer<Dog, double>>);
static_assert(
    std::is_convertible_v<IndexedPointer<Dog, double>, IndexedPointer<Dog, const double>>);
static_assert(!std::is_convertible_v<Dogs&, IndexedPointer<Cat, double>>);
static_assert(!std::is_convertible_v<const Dogs&, IndexedPointer<Dog, double>>);

// All that is known when it is compiled.
static_assert(!Dog().exists() && Dog(0).exists() && Dog(7).value() == 7);
static_assert(Dog(2) + 3 == Dog(5) && Dog(5) - 3 == Dog(2) && Dog(5) - Dog(2) == 3);
static_assert(Dog(1) < Dog(2) && Dog(2) > Dog(1) && Dog(1) <= Dog(1) && Dog(1) >= Dog(1));
static_assert(Dog() < Dog(0) && Dog() == Dog() && Dog() != Dog(0));

}  // namespace

TEST(TypedIndex, A_vector_gives_out_and_takes_its_own_indices) {
  Dogs dogs{1.0, 2.0, 3.0};
  EXPECT_THAT(numbers_in(indices_of(dogs)), ElementsAre(0, 1, 2));
  EXPECT_THAT(numbers_in(indices_down_of(dogs)), ElementsAre(2, 1, 0));
  static_assert(std::is_same_v<decltype(*indices_of(dogs).begin()), Dog>);
  for (const Dog i : indices_of(dogs)) dogs[i] *= 2.0;
  EXPECT_THAT(dogs, ElementsAre(2.0, 4.0, 6.0));
  const Dog next = dogs.end_index();
  EXPECT_FALSE(dogs.holds(next));
  dogs.push_back(8.0);
  EXPECT_TRUE(dogs.holds(next));
  EXPECT_EQ(dogs[next], 8.0);
  EXPECT_FALSE(dogs.holds(Dog()));
}

TEST(TypedIndex, Steps_and_ranges_are_those_of_numbers) {
  Dog i(3);
  ++i;
  i += 2;
  EXPECT_EQ(i, Dog(6));
  EXPECT_THAT(numbers_in(indices(Cat(2), Cat(4))), ElementsAre(2, 3));
  EXPECT_THAT(numbers_in(indices(Cat(2), Cat())), ElementsAre());
}

TEST(TypedIndex, A_pointer_is_indexed_as_the_vector_is) {
  Dogs dogs{1.0, 2.0};
  const IndexedPointer<Dog, double> all = dogs;
  const IndexedPointer<Dog, const double> seen = all;
  all[Dog(1)] = 5.0;
  EXPECT_EQ(seen[Dog(1)], 5.0);
  EXPECT_EQ(seen.data(), dogs.data());
}

TEST(TypedIndex, A_matrix_lies_row_by_row) {
  Scratches m(2, 3, 0.0);
  m(Cat(1), Dog(2)) = 7.0;
  EXPECT_EQ(m.data()[5], 7.0);
  EXPECT_EQ(m.row(Cat(1))[Dog(2)], 7.0);
  EXPECT_EQ(m.view()(Cat(1), Dog(2)), 7.0);
  EXPECT_EQ(m.size(), 6u);
  EXPECT_EQ(std::as_const(m).row(Cat(0))[Dog(2)], 0.0);
}

#ifndef NDEBUG
TEST(TypedIndexDeathTest, What_is_not_there_is_noticed) {
  Dogs dogs{1.0, 2.0};
  Scratches m(2, 3, 0.0);
  EXPECT_DEATH(dogs[Dog(2)] = 0.0, "holds");
  EXPECT_DEATH(dogs[Dog()] = 0.0, "holds");
  EXPECT_DEATH(m(Cat(2), Dog(0)) = 0.0, "holds");
  EXPECT_DEATH(m(Cat(0), Dog(3)) = 0.0, "holds");
  EXPECT_DEATH(m.view()(Cat(0), Dog(3)) = 0.0, "columns_");
}
#endif

}  // namespace linkstudy::testing::typed_index_test
