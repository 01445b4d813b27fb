// The built program, run as a user runs it: in a directory of its own, with its output and exit
// code, and inputs small enough to take milliseconds.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace linkstudy::testing {

struct Ended {
  int code = -1;  // exit code, or 128 + signal
  std::string out;
  std::string err;
};

// Where the built program is.
extern const char* const kProgram;

std::string read_text(const std::filesystem::path& path);

// Every test has an empty directory, which is the current one of what it runs.
class Program : public ::testing::Test {
 protected:
  Program();
  ~Program() override;

  // "linkstudy ARGUMENTS" by a shell; `before` stands in front ("mpirun -n 2").
  Ended run(const std::string& arguments, const std::string& before = "") const;
  // Wall time of a run that ends well.
  double seconds_of(const std::string& arguments) const;
  // Starts it without waiting; the process is the program itself.
  pid_t start(const std::vector<std::string>& arguments) const;

  // Waits for its end: exit code, or 128 + signal.
  static int code_of(pid_t child);

  std::filesystem::path path(const std::string& name) const { return directory_ / name; }
  void write(const std::string& name, const std::string& text) const;
  // Names in the directory, sorted; inputs written by write() are left out.
  std::vector<std::string> left_behind() const;

  // The three inputs below under their names.
  void write_inputs() const;

 private:
  std::filesystem::path directory_;
  mutable std::vector<std::string> inputs_;
};

// The RSRRP linkage over 0.2 s: model.toml.
std::string model_text();
// 12 stiffnesses and steps against the cut joint, with a trace: study.toml.
std::string study_text();
// tune.toml
std::string tune_text();
// [reference]: a file cut.csv with the force of S, heads as the channels.
extern const char* const kForceData;

// What is said of something on one line, however many it takes on the page.
std::string on_one_line(const std::string& out);

// The 64 digits after "results digest: ", or nothing.
std::string digest_in(const std::string& out);

}  // namespace linkstudy::testing
