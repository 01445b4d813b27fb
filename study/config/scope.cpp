#include "study/config/scope.h"

#include <fmt/format.h>

namespace linkstudy {
namespace {

std::string element_title(const Scope& scope) {
  const Tree* name = scope.element->find("name");
  const std::string list(scope.up->key);
  const Scope* owner = scope.up->up;
  while (owner != nullptr && owner->element == nullptr) owner = owner->up;
  const std::string above = owner == nullptr ? std::string() : subject_of(*owner);
  if (name != nullptr && name->is(Tree::Kind::text)) {
    return fmt::format("{}{} '{}'", above, list, name->text);
  }
  return fmt::format("{}{} {}", above, list, scope.index);
}

}  // namespace

std::string subject_of(const Scope& scope) {
  if (scope.element != nullptr) return element_title(scope) + ": ";
  const std::string above = scope.up == nullptr ? std::string() : subject_of(*scope.up);
  const bool is_first = above.empty() || above.ends_with(": ");
  return above + (is_first ? "" : ".") + std::string(scope.key);
}

std::string subject_of(const Scope& scope, std::string_view key) {
  return subject_of({.up = &scope, .key = key});
}

}  // namespace linkstudy
