#include "study/config/point_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "study/config/measured_data.h"
#include "study/config/named_parameter.h"
#include "study/config/value_list.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

constexpr const char* kIdColumn = "evaluation";

class PointFileReader {
 public:
  PointFileReader(Tree& study, const ModelDocument& document, Diagnostics& diagnostics)
      : study_(study),
        design_(*study.find("design")),
        document_(document),
        diagnostics_(diagnostics) {}

  void read(const std::string& study_path) {
    const Tree file = *design_.find("file");
    const auto folder = std::filesystem::path(study_path).parent_path();
    const std::string path = (folder / file.text).lexically_normal().string();
    refuse_vary();
    const std::optional<std::string> text = read_data_text(path, file.at, diagnostics_);
    if (!text) return;
    std::vector<WantedArray> wanted;
    const std::vector<WantedColumn> columns = columns_of(*text, path);
    if (columns.empty() && diagnostics_.empty()) {
      diagnostics_.add(file.at, fmt::format("'{}' has no column of a parameter", path),
                       "the heads are paths of the model, or columns says which they are");
    }
    for (const WantedColumn& column : columns) add_wanted(column, wanted);
    if (!diagnostics_.empty()) return;
    const auto arrays = parse_arrays(*text, path, file.at, wanted, diagnostics_);
    if (arrays) write_entries(wanted, *arrays);
  }

 private:
  void refuse_vary() {
    const Tree* vary = study_.find("vary");
    if (vary == nullptr || !vary->is(Kind::array) || vary->items.empty()) return;
    diagnostics_.add(vary->items.front().at,
                     "the points are those of design.file, and [[vary]] gives others",
                     "make it a column of the file, or take design.file out");
  }

  std::vector<WantedColumn> columns_of(const std::string& text, const std::string& path) {
    std::vector<WantedColumn> columns;
    const Tree* named = design_.find("columns");
    if (named == nullptr) {
      columns = list_columns(text, path);
      std::erase_if(columns, [](const auto& one) { return one.channel == kIdColumn; });
      return columns;
    }
    for (const Override& one : flatten_overrides(*named)) {
      if (one.value.is(Kind::text)) {
        columns.push_back({one.path, one.origin, one.value.text, one.value.at});
      } else {
        diagnostics_.add(one.value.at,
                         fmt::format("design: columns.{} must be the head of a column, got {}",
                                     one.path, shown(one.value)),
                         "write the head as it stands in the file, in quotes");
      }
    }
    if (named->keys.empty()) {
      diagnostics_.add(named->at, "design: columns names no parameter",
                       "columns = { \"closure.S.sde.stiffness\" = \"c [kN/m]\" }, or leave it out "
                       "where the heads are the paths");
    }
    return columns;
  }

  void add_wanted(const WantedColumn& column, std::vector<WantedArray>& wanted) {
    const Tree path = Tree::make_text(column.channel, column.channel_at);
    const auto named = find_named_parameter(document_, path, diagnostics_);
    if (!named) return;
    const std::string& unit = named->parameter.unit;
    wanted.push_back({column, unit.empty() ? "1" : unit, !is_numeric_row(*named->row)});
  }

  void write_entries(const std::vector<WantedArray>& wanted, const std::vector<Tree>& arrays) {
    Tree entries = Tree::make_array({}, design_.at);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const WantedColumn& column = wanted[i].column;
      Tree& entry = entries.items.emplace_back(Tree::make_table(column.channel_at));
      entry.set("parameter", Tree::make_text(column.channel, column.channel_at));
      entry.set("values", arrays[i]);
    }
    design_.erase("file");
    design_.erase("columns");
    study_.set("vary", std::move(entries));
  }

  Tree& study_;
  Tree& design_;
  const ModelDocument& document_;
  Diagnostics& diagnostics_;
};

const Tree* find_file(const Tree& study) {
  const Tree* design = study.find("design");
  return design == nullptr || !design->is(Kind::table) ? nullptr : design->find("file");
}

}  // namespace

bool has_point_file(const Tree& study) {
  const Tree* file = find_file(study);
  return file != nullptr && file->is(Kind::text);
}

bool read_point_file(Tree& study, const std::string& path, const ModelDocument& document,
                     Diagnostics& diagnostics) {
  Diagnostics found;
  PointFileReader(study, document, found).read(path);
  diagnostics.append(found);
  return found.empty();
}

}  // namespace linkstudy
