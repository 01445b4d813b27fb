#include "study/cli/tuning_group.h"

#include "study/tune/tuning_tables.h"

namespace linkstudy {

DataGroup make_tuning_group(const tuning::TuningResult& result) {
  DataGroup group;
  for (const tuning::Table& table : tuning::make_tables(result)) {
    DataGroup part;
    part.name = table.name;
    for (const tuning::Column& column : table.columns) {
      DataColumn copy;
      copy.name = column.name;
      copy.unit = column.unit;
      std::visit([&](const auto& values) { copy.values = values; }, column.values);
      part.columns.push_back(std::move(copy));
    }
    group.groups.push_back(std::move(part));
  }
  return group;
}

}  // namespace linkstudy
