#include "study/config/effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "study/config/value_path.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

// The element of [[tables]] that a path runs through.
struct Element {
  std::string list;
  std::string name;  // as written in paths
  std::size_t index = 0;
};

std::string name_of(const Tree& element, std::size_t index) {
  const Tree* name = element.find("name");
  return name != nullptr && name->is(Kind::text) ? name->text : std::to_string(index);
}

std::string place_text(const Location& at) {
  const std::string file = at.file ? *at.file : std::string();
  return at.line > 0 ? fmt::format("{}:{}:{}", file, at.line, at.column) : file;
}

// The state of a switch in one element.
struct Switch {
  std::string path;
  std::string word;  // empty: not given, and without default
  Location at;
  bool is_given = false;
  bool is_known = true;  // false: a value of a wrong kind, of which others tell
};

Switch read_switch(const Tree& table, const KeyNode& node, std::string path,
                   std::span<const std::string> keys) {
  const Tree* value = &table;
  const KeyNode* row = &node;
  Location at = table.at;
  for (const std::string& key : keys) {
    row = row == nullptr ? nullptr : row->find(key);
    value = value != nullptr && value->is(Kind::table) ? value->find(key) : nullptr;
    if (value != nullptr) at = value->at;
    path += (path.empty() ? "" : ".") + key;
  }
  Switch state{path, {}, at, value != nullptr, true};
  const bool has_default = row != nullptr && row->standard.has_value();
  const Tree* word = value != nullptr ? value : has_default ? &*row->standard : nullptr;
  if (word == nullptr) return state;
  if (word->is(Kind::text)) state.word = word->text;
  if (word->is(Kind::boolean)) state.word = word->boolean ? "true" : "false";
  state.is_known = !state.word.empty() || word->is_valid();
  return state;
}

class Judge {
 public:
  Judge(const Tree& document, const KeyNode& schema, const std::string& verb)
      : document_(document), schema_(schema), verb_(verb) {}

  // What takes the effect of a path away, if anything does. `own` is the path in the key tables.
  std::optional<Ineffective> judge(const Effect& effect, const std::string& path,
                                   const std::string& own,
                                   const std::optional<Element>& element) const {
    if (effect.key == own) return std::nullopt;
    if (effect.key == "verb") return judge_verb(effect, path);
    const std::vector<Switch> switches = switches_of(effect.key, element);
    const auto acts = [&](const Switch& state) {
      if (effect.words.empty()) return !state.is_given;
      return !state.is_known || std::ranges::count(effect.words, state.word) > 0;
    };
    if (std::ranges::any_of(switches, acts)) return std::nullopt;
    Ineffective found{path, {}, {}, {}, false, effect.stands_by};
    if (switches.empty()) {
      found.reason = fmt::format("there is no {}", split_path(effect.key).front());
      found.remedy = "remove it";
      return found;
    }
    const Switch& state = switches.front();
    found.reason = reason_of(state);
    found.remedy = remedy_of(effect, state);
    if (!effect.needs.empty() && switches_of(effect.needs, element).front().is_given) return found;
    found.is_lost = !effect.needs.empty();
    if (found.is_lost) {
      found.remedy += fmt::format(", which needs {}: add that, or remove it",
                                  switches_of(effect.needs, element).front().path);
    }
    return found;
  }

 private:
  std::optional<Ineffective> judge_verb(const Effect& effect, const std::string& path) const {
    if (verb_.empty() || std::ranges::count(effect.words, verb_) > 0) return std::nullopt;
    return Ineffective{path,
                       {},
                       fmt::format("{} does not use it", verb_),
                       fmt::format("it is for linkstudy {}", fmt::join(effect.words, ", ")),
                       false,
                       effect.stands_by};
  }

  // One, or that of every element where the path runs through another list.
  std::vector<Switch> switches_of(const std::string& key,
                                  const std::optional<Element>& element) const {
    const std::vector<std::string> parts = split_path(key);
    if (parts.size() < 3 || parts[1] != "*") return {read_switch(document_, schema_, {}, parts)};
    const std::span<const std::string> inner = std::span(parts).subspan(2);
    std::vector<Switch> switches;
    const Tree* list = document_.find(parts[0]);
    const KeyNode* node = schema_.find(parts[0])->element();
    for (std::size_t i = 0; list != nullptr && i < list->items.size(); ++i) {
      const bool is_own = element && element->list == parts[0];
      if (is_own && element->index != i) continue;
      const Tree& item = list->items[i];
      switches.push_back(
          read_switch(item, *node, fmt::format("{}.{}", parts[0], name_of(item, i)), inner));
    }
    return switches;
  }

  static std::string reason_of(const Switch& state) {
    const std::string place = place_text(state.at);
    if (state.word.empty()) return fmt::format("{} is given ({})", state.path, place);
    return fmt::format("{} = '{}'{} ({})", state.path, state.word,
                       state.is_given ? "" : " by default", place);
  }

  static std::string remedy_of(const Effect& effect, const Switch& state) {
    if (effect.words.empty()) return fmt::format("it acts where {} is not given", state.path);
    return fmt::format("it acts where {} = {}", state.path, fmt::join(effect.words, " or "));
  }

  const Tree& document_;
  const KeyNode& schema_;
  const std::string& verb_;
};

// Every value that is written, from the top down.
class Walk {
 public:
  Walk(const Tree& document, const KeyNode& schema, const std::string& verb)
      : judge_(document, schema, verb) {}

  void enter(const Tree& table, const KeyNode& node, const std::string& path,
             const std::string& own, const std::optional<Element>& element) {
    if (!table.is(Kind::table)) return;
    for (std::size_t i = 0; i < table.items.size(); ++i) {
      const std::string& key = table.keys[i].name;
      const KeyNode* child = key == "*" ? nullptr : node.find(key);
      if (child == nullptr) continue;
      const std::string dot = path.empty() ? "" : ".";
      visit(table.items[i], table.keys[i].at, *child, path + dot + key, own + dot + key, element);
    }
  }

  std::vector<Ineffective> found;

 private:
  void visit(const Tree& value, const Location& at, const KeyNode& node, const std::string& path,
             const std::string& own, const std::optional<Element>& element) {
    for (const Effect& effect : node.row.effects) {
      std::optional<Ineffective> one = judge_.judge(effect, path, own, element);
      if (!one) continue;
      one->at = at;
      return found.push_back(std::move(*one));
    }
    descend(value, node, path, own, element);
  }

  void descend(const Tree& value, const KeyNode& node, const std::string& path,
               const std::string& own, const std::optional<Element>& element) {
    if (node.row.type != KeyType::tables) return enter(value, node, path, own, element);
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      const Element inner{path, name_of(value.items[i], i), i};
      enter(value.items[i], *node.element(), path + "." + inner.name, own + ".*", inner);
    }
  }

  Judge judge_;
};

}  // namespace

std::vector<Ineffective> find_ineffective(const Tree& document, const KeyNode& schema,
                                          const std::string& verb) {
  Walk walk(document, schema, verb);
  walk.enter(document, schema, {}, {}, std::nullopt);
  return std::move(walk.found);
}

std::optional<Ineffective> find_ineffective(const Tree& document, const KeyNode& schema,
                                            const std::string& path, const std::string& verb) {
  const std::optional<ValuePath> value = find_value_path(document, schema, path);
  if (!value) return std::nullopt;
  const Judge judge(document, schema, verb);
  std::optional<Element> element;
  std::string own;
  for (std::size_t i = 0; i < value->parts.size() && value->nodes[i] != nullptr; ++i) {
    const bool is_element = i == 1 && value->nodes[0]->row.type == KeyType::tables;
    own += (i == 0 ? "" : ".") + (is_element ? "*" : value->parts[i]);
    if (is_element && value->parts[1] != "*") {
      element = Element{value->parts[0], {}, std::stoul(value->parts[1])};
    }
  }
  for (const KeyNode* node : value->nodes) {
    if (node == nullptr) break;
    for (const Effect& effect : node->row.effects) {
      if (auto one = judge.judge(effect, path, own, element)) return one;
    }
  }
  return std::nullopt;
}

}  // namespace linkstudy
