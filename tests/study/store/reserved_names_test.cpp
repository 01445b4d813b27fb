// Columns beside parameters and responses, and the names that responses may not have.
#include <gmock/gmock.h>

#include <algorithm>

#include "study/record/column_names.h"
#include "study/store/results_tree.h"

namespace linkstudy::reserved_names_test {
namespace {

TEST(ReservedNames, Are_those_of_all_columns_of_a_table_of_evaluations) {
  std::vector<std::string> names;
  for (const Table& group : {study_group({}, {}), runtime_group({})}) {
    for (const Column& column : group.columns) {
      if (!std::ranges::count(names, column.name)) names.push_back(column.name);
    }
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAreArray(kEvaluationColumns));
}

}  // namespace
}  // namespace linkstudy::reserved_names_test
