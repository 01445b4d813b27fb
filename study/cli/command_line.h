// The command line: one verb, its inputs and the options that apply to it. Options that a verb does
// not have are refused, and no option may be abbreviated.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "study/config/input_error.h"
#include "study/kinematics/course.h"
#include "study/session/options.h"

namespace linkstudy {

// What the rooms below take of it are its bases.
struct CommandLine : SessionOptions, CourseRequest {
  std::string verb;
  std::vector<std::string> inputs;
  bool help = false;

  std::optional<std::uint64_t> seed;
  std::optional<int> batch;
  std::optional<std::string> on_failure;    // record, abort
  std::optional<std::string> max_failures;  // N or P%
  std::optional<double> timeout_s;
  bool json = false;
  bool markdown = false;
  bool completion = false;
  std::optional<std::string> man;
  bool traces = false;
  bool list = false;
  bool watch = false;
  bool all = false;
  std::optional<int> count;
  std::optional<std::string> table;
  std::optional<std::string> columns;  // a,b
  std::optional<std::string> rows;     // report/choose_table.h
  bool slurm = false;
  std::optional<std::string> csv;
  std::optional<std::string> signals;  // a,b
  std::optional<std::string> format;
  std::optional<std::string> h5;
  std::optional<int> ranks;
  std::optional<int> modes;
  std::optional<std::string> write_start;
  std::optional<int> group;
  double wait_s = 0.0;
  double probe_s = 2.0;
  std::optional<std::uint64_t> evaluation;
  std::optional<std::string> figure;
};

// Throws UsageError. The verb "version" or "help" stands for --version and --help alone.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

// Throws UsageError with the message unless it holds.
void require(bool holds, const std::string& message);

// How to use the program, or one verb.
std::string usage();
std::string usage_of(const std::string& verb);

}  // namespace linkstudy
