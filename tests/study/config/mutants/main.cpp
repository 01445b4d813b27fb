// Mutated inputs: the shipped configurations, damaged at random, must end in located errors or be
// right; never in an exception, a crash or a hang. Made for the sanitizers; bounded in number.
// Input ID of a seed is always the same text.
// usage: test_study_config_mutants CONFIGS COUNT [FIRST_ID [SEED]]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/model/compile.h"
#include "study/config/check_file.h"
#include "study/config/study_input.h"
#include "study/config/toml_reader.h"
#include "tests/study/config/mutants/mutate.h"

namespace linkstudy::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Where a check takes longer than this even under the sanitizers, its cost has no bound.
constexpr double kLongestCheck_s = 30.0;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

// A copy of the configurations, so that the model paths of mutated studies name files.
class Corpus {
 public:
  explicit Corpus(const fs::path& configs) {
    std::string pattern = (fs::temp_directory_path() / "linkstudy_mutants.XXXXXX").string();
    root_ = mkdtemp(pattern.data());
    fs::copy(configs, root_, fs::copy_options::recursive);
    for (const auto& entry : fs::recursive_directory_iterator(root_)) {
      if (entry.path().extension() == ".toml") paths_.push_back(entry.path());
    }
    std::sort(paths_.begin(), paths_.end());
    for (const fs::path& path : paths_) texts_.push_back(text_of(path));
  }

  const std::vector<std::string>& texts() const { return texts_; }
  // Where a mutant of input `source` lies: beside it.
  fs::path mutant_of(std::size_t source) const {
    return paths_[source].parent_path() / "mutant.toml";
  }
  void remove() const { fs::remove_all(root_); }

 private:
  fs::path root_;
  std::vector<fs::path> paths_;
  std::vector<std::string> texts_;
};

enum class Verdict { right, refused, broken };

Verdict broken(const std::string& what) {
  fmt::print(stderr, "  {}\n", what);
  return Verdict::broken;
}

bool is_model(const std::string& path) {
  Diagnostics ignored;
  const std::optional<Tree> tree = read_toml_file(path, ignored);
  return tree && kind_of(*tree, ignored) == FileKind::model;
}

Verdict check(const std::string& path) {
  const std::vector<Diagnostic> found = check_file(path);
  const std::string text = text_of(path);
  const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
  for (const Diagnostic& diagnostic : found) {
    if (diagnostic.message.empty() || diagnostic.remedy.empty() || diagnostic.file.empty()) {
      return broken("an error without message, remedy or file: " + to_string(diagnostic));
    }
    if (diagnostic.file == path && (diagnostic.line < 0 || diagnostic.line > lines)) {
      return broken("an error outside the text: " + to_string(diagnostic));
    }
  }
  if (!found.empty()) return Verdict::refused;
  if (is_model(path)) {
    Diagnostics none;
    compile(ModelDocument::load(path, none)->with({}, none)->linkage);
  }
  return Verdict::right;
}

Verdict check_in_time(const std::string& path) {
  const Clock::time_point begin = Clock::now();
  Verdict verdict = Verdict::broken;
  try {
    verdict = check(path);
  } catch (const std::exception& error) {
    return broken(fmt::format("an exception: {}", error.what()));
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return seconds > kLongestCheck_s ? broken(fmt::format("took {:.0f} s", seconds)) : verdict;
}

int run(const fs::path& configs, int count, int first, unsigned seed) {
  const Corpus corpus(configs);
  const Dictionary dictionary = make_dictionary(corpus.texts());
  int right = 0, refused = 0;
  for (int id = first; id < first + count; ++id) {
    const Mutant mutant = make_mutant(corpus.texts(), dictionary, seed, id);
    const fs::path path = corpus.mutant_of(mutant.source);
    write_text(path, mutant.text);  // stays where the check does not return
    const Verdict verdict = check_in_time(path.string());
    if (verdict == Verdict::broken) {
      fmt::print(stderr, "input {} of seed {}: {}\n", id, seed, path.string());
      return EXIT_FAILURE;
    }
    ++(verdict == Verdict::right ? right : refused);
    fs::remove(path);
  }
  corpus.remove();
  fmt::print("{} mutated inputs: {} right, {} refused\n", count, right, refused);
  // Damage that is never seen, or always, tests nothing.
  return refused > right && right > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace linkstudy::test

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: {} CONFIGS COUNT [FIRST_ID [SEED]]\n", argv[0]);
    return 2;
  }
  const int first = argc > 3 ? std::atoi(argv[3]) : 0;
  const unsigned seed = argc > 4 ? static_cast<unsigned>(std::atoi(argv[4])) : 1u;
  return linkstudy::test::run(argv[1], std::atoi(argv[2]), first, seed);
}
