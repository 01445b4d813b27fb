#include "study/config/toml_reader.h"

#include <fmt/format.h>

#include "study/config/toml_parser.h"
#include "study/config/toml_text.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace linkstudy {
namespace {

using File = std::shared_ptr<const std::string>;

Location at(const File& file, const toml::source_region& source) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

class Converter {
 public:
  Converter(File file, Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  Tree convert(const toml::node& node) {
    const Location place = at(file_, node.source());
    if (const auto* value = node.as_boolean()) return Tree::make_boolean(value->get(), place);
    if (const auto* value = node.as_integer()) return Tree::make_integer(value->get(), place);
    if (const auto* value = node.as_floating_point()) return Tree::make_number(value->get(), place);
    if (const auto* value = node.as_string()) return Tree::make_text(value->get(), place);
    if (const auto* value = node.as_array()) return convert_array(*value, place);
    if (const auto* value = node.as_table()) return convert_table(*value, place);
    diagnostics_.add(place, "dates and times are not used here", "write a number or a text");
    Tree invalid;
    invalid.at = place;
    return invalid;
  }

 private:
  Tree convert_array(const toml::array& array, const Location& place) {
    Tree tree = Tree::make_array({}, place);
    for (const toml::node& item : array) tree.items.push_back(convert(item));
    return tree;
  }

  // toml++ sorts keys by name; the order of the text is restored from their places.
  Tree convert_table(const toml::table& table, const Location& place) {
    struct Item {
      Tree::Key key;
      Tree value;
    };
    std::vector<Item> items;
    for (const auto& [key, value] : table) {
      items.push_back({{std::string(key.str()), at(file_, key.source())}, convert(value)});
    }
    const auto earlier = [](const Item& a, const Item& b) {
      const Location& p = a.key.at;
      const Location& q = b.key.at;
      return p.line != q.line ? p.line < q.line : p.column < q.column;
    };
    std::stable_sort(items.begin(), items.end(), earlier);
    Tree tree = Tree::make_table(place);
    for (Item& item : items) {
      tree.keys.push_back(std::move(item.key));
      tree.items.push_back(std::move(item.value));
    }
    return tree;
  }

  File file_;
  Diagnostics& diagnostics_;
};

void add_file_error(const std::string& path, const std::string& message, const char* remedy,
                    Diagnostics& diagnostics) {
  diagnostics.add(make_location(path), message, remedy);
}

}  // namespace

std::optional<std::string> read_text_file(const std::string& path, Diagnostics& diagnostics) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    add_file_error(path, "an input file is expected, got a directory", "name a file in it",
                   diagnostics);
    return std::nullopt;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) {
    add_file_error(path, fmt::format("the file cannot be opened: {}", std::strerror(errno)),
                   "check its name and its permissions", diagnostics);
    return std::nullopt;
  }
  std::string text;
  std::string block(std::size_t{1} << 16, '\0');
  while (text.size() <= kLargestInput) {
    const std::size_t count = std::fread(block.data(), 1, block.size(), file.get());
    text.append(block, 0, count);
    if (count < block.size()) break;
  }
  if (std::ferror(file.get()) != 0) {
    add_file_error(path, "the file cannot be read", "check the disk it is on", diagnostics);
    return std::nullopt;
  }
  if (text.size() > kLargestInput) {
    add_file_error(path, "the file is larger than 16 MiB", "an input is text of a few kilobytes",
                   diagnostics);
    return std::nullopt;
  }
  return text;
}

std::optional<Tree> parse_toml(std::string_view text, const std::string& file,
                               Diagnostics& diagnostics) {
  const File shared = std::make_shared<const std::string>(file);
  if (!check_toml_text(text, shared, diagnostics)) return std::nullopt;
  try {
    const toml::table table = toml::parse(text);
    Diagnostics found;
    Tree tree = Converter(shared, found).convert(table);
    tree.at = {shared, 1, 1};
    diagnostics.append(found);
    if (!found.empty()) return std::nullopt;
    return tree;
  } catch (const toml::parse_error& error) {
    diagnostics.add(at(shared, error.source()), fmt::format("not TOML: {}", error.description()),
                    "correct the syntax; text stands in quotes, tables in [brackets]");
  }
  return std::nullopt;
}

std::optional<Tree> read_toml_file(const std::string& path, Diagnostics& diagnostics) {
  const std::optional<std::string> text = read_text_file(path, diagnostics);
  if (!text) return std::nullopt;
  if (text->find_first_not_of(" \t\r\n") == std::string::npos) {
    diagnostics.add(make_location(path, 1, 1), "the file is empty",
                    "write at least format = 1 and kind = \"model\"");
    return std::nullopt;
  }
  return parse_toml(*text, path, diagnostics);
}

}  // namespace linkstudy
