#include "study/config/fill.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/validate.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

class Filler {
 public:
  Filler(Tree& document, Diagnostics& diagnostics)
      : document_(document), diagnostics_(diagnostics) {}

  // Of the keys of `table`; `element` is the element of [[tables]] that it is, or is in.
  void fill_table(void* record, Tree& table, const KeyNode& node, const Scope* scope,
                  const Tree* element) {
    for (const KeyNode& child : node.children) {
      Tree* value = table.find(child.name);
      if (value == nullptr && child.row.derive && element != nullptr) {
        value = add_derived(table, child, *element);
      }
      if (value == nullptr || !value->is_valid()) continue;
      fill_value(record, *value, child, {.up = scope, .key = child.name}, element);
    }
  }

 private:
  static Tree* add_derived(Tree& table, const KeyNode& child, const Tree& element) {
    std::optional<Tree> standard = child.row.derive(element);
    if (!standard) return nullptr;
    Tree& value = table.set(child.name, std::move(*standard));
    if (value.is(Kind::table)) {
      Diagnostics none;
      validate(value, child, none);
    }
    if (!value.at.file) relocate(value, table.at);  // else it stands where a neighbour does
    table.keys.back().at = value.at;
    return &value;
  }

  void fill_value(void* record, Tree& value, const KeyNode& node, const Scope& scope,
                  const Tree* element) {
    if (node.row.type == KeyType::tables) return fill_elements(record, value, node, scope);
    const Reading reading{document_, element, scope, diagnostics_};
    if (value.is(Kind::table) && !node.children.empty()) {
      void* inner = enter(record, node.row);
      fill_table(inner, value, node, &scope, element);
      if (node.row.bind.finish) node.row.bind.finish(inner, value, reading);
    }
    if (node.row.units_by && element != nullptr) check_units(value, node.row, reading);
    if (node.row.bind.fill && value.is_valid()) node.row.bind.fill(record, value, reading);
  }

  // An element that is no table keeps its position for the paths of check().
  void fill_elements(void* record, Tree& list, const KeyNode& node, const Scope& scope) {
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      Tree& item = list.items[i];
      void* inner = enter(record, node.row);
      if (!item.is(Kind::table)) continue;
      const Scope own{.up = &scope, .key = {}, .element = &item, .index = i};
      fill_table(inner, item, *node.element(), &own, &item);
      const Reading reading{document_, &item, own, diagnostics_};
      if (node.row.bind.finish) node.row.bind.finish(inner, item, reading);
    }
  }

  static void* enter(void* record, const KeyRow& row) {
    return row.bind.enter ? row.bind.enter(record) : record;
  }

  static void check_units(Tree& value, const KeyRow& row, const Reading& reading) {
    const std::vector<std::string> units = row.units_by(reading.document, *reading.element);
    if (units.empty()) return;
    if (!value.is(Kind::array))
      return check_unit(value, units[0], subject_of(reading.scope), reading);
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      if (units.size() > 1 && i >= units.size()) break;
      const std::string subject = subject_of(reading.scope, std::to_string(i));
      check_unit(value.items[i], units.size() > 1 ? units[i] : units[0], subject, reading);
    }
    const auto is_known = [](const Tree& item) { return item.is_valid(); };
    if (!std::ranges::all_of(value.items, is_known)) value.kind = Kind::invalid;
  }

  // A plain number is in whatever unit holds.
  static void check_unit(Tree& value, const std::string& unit, const std::string& subject,
                         const Reading& reading) {
    if (!value.is_valid() || value.text.empty() || value.text == unit) return;
    reading.report(value,
                   fmt::format("{} must be {} here, got a value in {}", subject,
                               unit == "1" ? "a pure number" : "in " + unit, value.text),
                   "the joint type and the load type decide between lengths and angles");
  }

  Tree& document_;
  Diagnostics& diagnostics_;
};

}  // namespace

void fill_record(void* record, Tree& document, const KeyNode& schema, Diagnostics& diagnostics) {
  Filler(document, diagnostics).fill_table(record, document, schema, nullptr, nullptr);
}

}  // namespace linkstudy
