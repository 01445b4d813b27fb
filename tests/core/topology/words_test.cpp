// The words of enumerations: each enumerator has one, which reads back to it.
#include "core/topology/linkage_words.h"

#include <gtest/gtest.h>

#include "core/base/isa.h"
#include "core/laws/contact_law.h"

namespace linkstudy::words_test {
namespace {

// Counts enumerators by what the compiler calls them, not by the table.
template <class E, std::size_t... i>
constexpr std::size_t count_enumerators(std::index_sequence<i...>) {
  return (std::size_t{is_enumerator<static_cast<E>(i)>()} + ...);
}

template <class E>
class Words : public ::testing::Test {};

using Enumerations =
    ::testing::Types<InstructionSet, ContactLaw, ApproachSpeed, JointType, RotationCoordinates,
                     ClosureModel, Stabilization, SdeForm, SdeAxes, TiltMeasure, SdeStart,
                     ClearanceKind, FreeBristle, ContactPoints, CourseShape, ResistanceShape>;
TYPED_TEST_SUITE(Words, Enumerations);

TYPED_TEST(Words, There_is_one_for_every_enumerator_and_it_reads_back) {
  constexpr std::size_t kMany = 32;
  EXPECT_EQ(kWords<TypeParam>.size(),
            count_enumerators<TypeParam>(std::make_index_sequence<kMany>()));
  for (std::size_t i = 0; i < kWords<TypeParam>.size(); ++i) {
    const auto value = static_cast<TypeParam>(i);
    EXPECT_FALSE(name_of(value).empty());
    EXPECT_EQ(find_word<TypeParam>(name_of(value)), value);
  }
  EXPECT_EQ(find_word<TypeParam>("unheard_of"), std::nullopt);
}

TEST(DirectionNames, Are_named_in_their_order) {
  EXPECT_STREQ(kDirectionNames[kX], "x");
  EXPECT_STREQ(kDirectionNames[kPhi], "phi");
  EXPECT_STREQ(kDirectionNames[kPsi], "psi");
}

}  // namespace
}  // namespace linkstudy::words_test
