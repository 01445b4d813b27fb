#include "study/config/model_reader.h"

#include <charconv>

#include "core/topology/check_linkage.h"
#include "study/config/fill.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

// What check() says about connections is only as good as the names and types it was given.
bool structure_is_known(const Tree& model) {
  const auto all_known = [&](const char* list, std::initializer_list<const char*> keys) {
    const Tree* records = model.find(list);
    if (records == nullptr || !records->is(Kind::array)) return false;
    for (const Tree& record : records->items) {
      for (const char* key : keys) {
        const Tree* value = record.find(key);
        if (value == nullptr || !value->is_valid()) return false;
      }
    }
    return true;
  };
  return all_known("link", {"name"}) && all_known("joint", {"name", "type", "parent", "child"});
}

bool is_about_connections(const std::string& path) {
  const std::vector<std::string> parts = split_path(path);
  const std::string& last = parts.back();
  return parts.size() == 2 || last == "parent" || last == "child" || last == "link" ||
         last == "joint" || last == "coordinate";
}

// Which keys a load or a motion needs follows from its type or law.
bool kind_is_known(const Tree& model, const std::string& path) {
  const std::vector<std::string> parts = split_path(path);
  bool reported = false;
  if (parts[0] == "load") locate(model, parts[0] + "." + parts[1] + ".type", &reported);
  if (parts[0] == "motion") locate(model, parts[0] + "." + parts[1] + ".law.shape", &reported);
  return !reported;
}

void check_structure(const Linkage& linkage, const Tree& model, Diagnostics& diagnostics) {
  const bool known = structure_is_known(model);
  for (Problem& problem : check(linkage)) {
    bool reported = false;
    const Location at = locate(model, problem.path, &reported);
    if (reported || (!known && is_about_connections(problem.path))) continue;
    if (!kind_is_known(model, problem.path)) continue;
    diagnostics.add(at, std::move(problem.message), std::move(problem.remedy));
  }
}

// Self-stresses of loops are those of closures; a coupling would take part in them.
void check_shared_reactions(const ModelInput& input, const Tree& model, Diagnostics& diagnostics) {
  const bool shares = input.options.redundant_reactions == RedundantReactions::loops;
  if (!shares || input.linkage.couplings.empty()) return;
  diagnostics.add(locate(model, "simulation.redundant_reactions"),
                  "simulation.redundant_reactions = \"loops\" does not know couplings",
                  "use \"cut\", or leave out [[coupling]]");
}

const Tree* descend(const Tree& tree, const std::string& part) {
  if (tree.is(Kind::table)) {
    const Tree* value = tree.find(part);
    // A link may give its inertia in the other form.
    return value == nullptr && part == "inertia" ? tree.find("inertia_at_origin") : value;
  }
  for (const Tree& item : tree.items) {
    const Tree* own = item.find("name");
    if (own != nullptr && own->is(Kind::text) && own->text == part) return &item;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool is_index = error == std::errc() && end == part.data() + part.size();
  return is_index && index < tree.items.size() ? &tree.items[index] : nullptr;
}

}  // namespace

Location locate(const Tree& document, const std::string& path, bool* reported) {
  const Tree* tree = &document;
  for (const std::string& part : split_path(path)) {
    const Tree* next = descend(*tree, part);
    if (next == nullptr) break;
    tree = next;
    if (!tree->is_valid() && reported != nullptr) *reported = true;
  }
  return tree->at;
}

ModelInput read_model(Tree model, Diagnostics& diagnostics) {
  ModelInput input;
  fill_record(&input, model, model_schema(), diagnostics);
  input.linkage.name = input.name;
  check_structure(input.linkage, model, diagnostics);
  check_shared_reactions(input, model, diagnostics);
  input.resolved = std::move(model);
  return input;
}

}  // namespace linkstudy
