#include "study/config/key_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/topology/nearest_name.h"
#include "study/config/key.h"

namespace linkstudy {
namespace {

struct Section {
  std::string_view name;
  std::string_view title;
  const std::vector<KeyRow>& rows;
};

std::vector<Section> sections() {
  std::vector<Section> all;
  for (const Word<FileKind>& kind : kWords<FileKind>) {
    all.push_back({kind.text, kind.meaning, key_rows(kind.value)});
  }
  return all;
}

std::string type_text(const KeyRow& row) {
  const std::string counts =
      row.counts.empty() ? std::string() : fmt::format("{} ", fmt::join(row.counts, " or "));
  switch (row.type) {
    case KeyType::number:
      return "number";
    case KeyType::number_or_table:
      return "number or table";
    case KeyType::number_or_numbers:
      return "number or numbers";
    case KeyType::integer:
      return "integer";
    case KeyType::boolean:
      return "true, false";
    case KeyType::word:
      return fmt::format("{}", fmt::join(row.words, ", "));
    case KeyType::name:
      return "name";
    case KeyType::text:
      return "text";
    case KeyType::texts:
      return "array of texts";
    case KeyType::numbers:
      return counts + "numbers";
    case KeyType::matrix:
      return "3 x 3 matrix";
    case KeyType::scalar:
      return "value";
    case KeyType::scalars:
      return counts + "values";
    case KeyType::tables:
      return "[[tables]]";
    case KeyType::table:
      return "table";
    case KeyType::overrides:
      return "paths = values";
    case KeyType::planned:
      break;
  }
  return {};
}

std::string unit_text(const KeyRow& row) {
  return fmt::format("{}", fmt::join(unit_alternatives(row.unit), " or "));
}

std::string condition_text(const KeyRow& row) {
  if (row.only.key.empty()) return {};
  return fmt::format(" ({} = {})", row.only.key, fmt::join(row.only.words, ", "));
}

// "\n    acts where closure.*.model = cut, clearance"
std::string effect_text(const KeyRow& row) {
  std::string text;
  for (const Effect& effect : row.effects) {
    text += fmt::format("{} {}{}", text.empty() ? "\n    acts where" : " and", effect.key,
                        effect.words.empty() ? std::string(" is not given")
                                             : fmt::format(" = {}", fmt::join(effect.words, ", ")));
  }
  return text;
}

std::string need_text(const KeyRow& row) {
  if (!row.standard.empty()) return row.standard;
  if (!row.required) return {};
  return row.group.empty() ? "required" : "one required";
}

// "; kg, > 0", "; max | rms"; empty where there is nothing to say.
std::string bounds_text(const KeyRow& row) {
  std::vector<std::string> parts;
  if (row.words.size() > 1) parts.push_back(fmt::format("{}", fmt::join(row.words, " | ")));
  if (!row.unit.empty()) parts.push_back(unit_text(row));
  if (!row.range.is_everything()) parts.push_back(range_symbol(row.range));
  return parts.empty() ? "" : fmt::format("; {}", fmt::join(parts, ", "));
}

// "*" stands for a name, or for the position where entries have none.
bool covers(const std::vector<std::string>& prefix, const std::vector<std::string>& pattern) {
  if (prefix.size() > pattern.size()) return false;
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    if (pattern[i] != "*" && pattern[i] != prefix[i]) return false;
  }
  return true;
}

// "joint.A.initial.position.0" asks for the array it is an element of.
std::vector<std::string> without_index(std::vector<std::string> parts) {
  const bool is_index =
      !parts.back().empty() && parts.back().find_first_not_of("0123456789") == std::string::npos;
  if (is_index && parts.size() > 2) parts.pop_back();
  return parts;
}

std::string row_text(const KeyRow& row) {
  std::string text = fmt::format("{}\n    {}{}\n    type: {}", row.path, row.meaning,
                                 condition_text(row), type_text(row));
  if (!row.unit.empty()) text += "; unit: " + unit_text(row);
  if (!row.range.is_everything()) text += "; range: " + range_symbol(row.range);
  if (row.required) text += "; " + need_text(row);
  if (!row.standard.empty()) text += "; default: " + row.standard;
  return text + effect_text(row) + "\n";
}

std::string section_text(const Section& section, const std::vector<std::string>& prefix) {
  std::string text;
  for (const KeyRow& row : section.rows) {
    if (row.type == KeyType::planned || !covers(prefix, split_path(row.path))) continue;
    text += row_text(row);
  }
  if (text.empty()) return text;
  return fmt::format("kind = \"{}\": {}\n\n{}\n", section.name, section.title, text);
}

std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

std::string code(const std::string& text) {
  return text.empty() ? text : "`" + text + "`";
}

}  // namespace

std::optional<std::string> describe(const std::string& path_prefix) {
  std::vector<std::string> prefix;
  if (!path_prefix.empty()) prefix = without_index(split_path(path_prefix));
  std::string text;
  for (const Section& section : sections()) {
    const bool is_named = !prefix.empty() && prefix.front() == section.name;
    const std::vector<std::string> inner(prefix.begin() + (is_named ? 1 : 0), prefix.end());
    if (is_named) text = section_text(section, inner);
    if (!text.empty()) return text;
  }
  for (const Section& section : sections()) text += section_text(section, prefix);
  if (text.empty()) return std::nullopt;
  return text;
}

KeyDescription describe_key(const std::string& kind, const std::string& path) {
  for (const Section& section : sections()) {
    const auto row = std::ranges::find(section.rows, path, &KeyRow::path);
    if (kind != section.name || row == section.rows.end()) continue;
    const std::string last = split_path(path).back();
    return {fmt::format("{} = {}", last, row->standard), row->meaning + bounds_text(*row)};
  }
  throw std::logic_error(fmt::format("there is no key '{}' of kind {}", path, kind));
}

std::vector<std::string> nearest_keys(const std::string& path_prefix) {
  constexpr std::size_t most = 3;
  std::vector<std::string> paths;
  for (const Section& section : sections()) {
    for (const KeyRow& row : section.rows) {
      const bool is_new = std::find(paths.begin(), paths.end(), row.path) == paths.end();
      if (row.type != KeyType::planned && is_new) paths.push_back(row.path);
    }
  }
  // "mass" without what it is of.
  std::vector<std::string> named;
  for (const std::string& path : paths) {
    if (named.size() < most && path.ends_with("." + path_prefix)) named.push_back(path);
  }
  return named.empty() ? nearest_names(path_prefix, paths, most) : named;
}

std::string key_reference_markdown() {
  std::string text;
  for (const Section& section : sections()) {
    text += fmt::format("## `kind = \"{}\"`: {}\n\n", section.name, section.title);
    text += "| key | type | unit | range | default | meaning |\n";
    text += "| --- | --- | --- | --- | --- | --- |\n";
    for (const KeyRow& row : section.rows) {
      if (row.type == KeyType::planned) continue;
      const bool is_value = !row.standard.empty();
      text += fmt::format("| `{}` | {} | {} | {} | {} | {}{} |\n", row.path,
                          escaped(type_text(row)), unit_text(row), range_symbol(row.range),
                          is_value ? code(need_text(row)) : need_text(row), escaped(row.meaning),
                          escaped(condition_text(row)));
    }
    text += "\n";
  }
  return text;
}

}  // namespace linkstudy
