#include "study/config/table_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/topology/nearest_name.h"
#include "study/config/measured_data.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

class TableFileReader {
 public:
  TableFileReader(const Tree& document, std::filesystem::path folder, Diagnostics& diagnostics)
      : document_(document), folder_(std::move(folder)), diagnostics_(diagnostics) {}

  // `element`: of [[tables]], that the table is or is in.
  void read(Tree& table, const KeyNode& node, const Scope* scope, const Tree* element) {
    const KeyNode* columns = node.find("columns");
    const bool has_rows = columns != nullptr && !columns->children.empty();
    const Tree* file = table.find("file");
    const bool is_named = file != nullptr && file->is(Kind::text) && !file->text.empty();
    if (has_rows && is_named && element != nullptr) replace(table, node, scope, *element);
    for (std::size_t i = 0; i < table.keys.size(); ++i) {
      const KeyNode* child = node.find(table.keys[i].name);
      if (child == nullptr) continue;
      const Scope inner{.up = scope, .key = child->name};
      descend(table.items[i], *child, inner, element);
    }
  }

 private:
  void descend(Tree& value, const KeyNode& node, const Scope& scope, const Tree* element) {
    if (node.row.type != KeyType::tables) {
      if (value.is(Kind::table)) read(value, node, &scope, element);
      return;
    }
    if (!value.is(Kind::array)) return;
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      Tree& item = value.items[i];
      const Scope inner{.up = &scope, .key = {}, .element = &item, .index = i};
      if (item.is(Kind::table)) read(item, *node.element(), &inner, &item);
    }
  }

  void replace(Tree& table, const KeyNode& node, const Scope* scope, const Tree& element) {
    const Tree file = *table.find("file");
    const std::string path = (folder_ / file.text).lexically_normal().string();
    const std::vector<WantedArray> wanted = wanted_of(table, node, scope, element);
    std::optional<std::string> text;
    if (wanted.size() == 2) text = read_data_text(path, file.at, diagnostics_);
    auto arrays = text ? parse_arrays(*text, path, file.at, wanted, diagnostics_) : std::nullopt;
    if (!arrays) {
      table.kind = Kind::invalid;
      return;
    }
    table.erase("file");
    table.erase("columns");
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const std::string& key = wanted[i].column.channel;
      table.set(key, std::move((*arrays)[i]));
      table.keys.back().at = wanted[i].column.channel_at;
    }
  }

  // Fewer than two where something was reported.
  std::vector<WantedArray> wanted_of(const Tree& table, const KeyNode& node, const Scope* scope,
                                     const Tree& element) {
    const Tree* columns = table.find("columns");
    const KeyNode& rows = *node.find("columns");
    std::vector<WantedArray> wanted;
    const bool is_table = columns != nullptr && columns->is(Kind::table);
    for (std::size_t i = 0; is_table && i < columns->keys.size(); ++i) {
      const KeyNode* row = rows.find(columns->keys[i].name);
      if (!check_column(*columns, i, row, rows, scope)) continue;
      const KeyNode& array = *node.find(row->row.held);
      const Tree& head = columns->items[i];
      wanted.push_back(
          {{array.name, columns->keys[i].at, head.text, head.at}, units_of(array.row, element)});
      require_alone(table, array.name, scope);
    }
    if (columns == nullptr || (is_table && columns->keys.size() != 2)) {
      diagnostics_.add(columns == nullptr ? table.find_key("file")->at : columns->at,
                       fmt::format("{} must name two columns of the file",
                                   subject_of({.up = scope, .key = "columns"})),
                       fmt::format("columns = {{ {} = \"t [s]\", {} = \"F [N]\" }}",
                                   rows.children.front().name, rows.children.back().name));
    } else if (!is_table) {
      diagnostics_.add(columns->at,
                       fmt::format("{} must be a table, got {}",
                                   subject_of({.up = scope, .key = "columns"}), shown(*columns)),
                       "columns = { name = \"head\", ... }");
    }
    return wanted;
  }

  bool check_column(const Tree& columns, std::size_t i, const KeyNode* row, const KeyNode& rows,
                    const Scope* scope) {
    const Tree::Key& key = columns.keys[i];
    const Scope own{.up = scope, .key = "columns"};
    if (row == nullptr) {
      diagnostics_.add(key.at, fmt::format("{} is not a known key", subject_of(own, key.name)),
                       suggest_name(key.name, rows.child_names()));
      return false;
    }
    if (columns.items[i].is(Kind::text)) return true;
    diagnostics_.add(columns.items[i].at,
                     fmt::format("{} must be the head of a column, got {}",
                                 subject_of(own, key.name), shown(columns.items[i])),
                     "write the head as it stands in the file, in quotes");
    return false;
  }

  void require_alone(const Tree& table, const std::string& array, const Scope* scope) {
    const Tree::Key* key = table.find_key(array);
    if (key == nullptr) return;
    diagnostics_.add(key->at,
                     fmt::format("{} and {} exclude each other",
                                 subject_of({.up = scope, .key = "file"}), array),
                     "give one of them only");
  }

  std::string units_of(const KeyRow& row, const Tree& element) const {
    const std::vector<std::string> known =
        row.units_by ? row.units_by(document_, element) : std::vector<std::string>();
    return known.empty() ? row.unit : known.front();
  }

  const Tree& document_;
  std::filesystem::path folder_;
  Diagnostics& diagnostics_;
};

}  // namespace

bool read_table_files(Tree& document, const KeyNode& schema, const std::string& path,
                      Diagnostics& diagnostics) {
  Diagnostics found;
  TableFileReader reader(document, std::filesystem::path(path).parent_path(), found);
  reader.read(document, schema, nullptr, nullptr);
  diagnostics.append(found);
  return found.empty();
}

void refuse_left_file(Tree& value, const Reading& reading) {
  reading.report(value, subject_of(reading.scope) + " cannot be set: files are read with the model",
                 "set the numbers themselves, or write a model for each file");
}

void refuse_left_columns(Tree& value, const Reading& reading) {
  reading.report(value, subject_of(reading.scope) + " are those of a file, and none is given",
                 "add file = \"...\", or leave columns out");
}

}  // namespace linkstudy
