// The command line: one verb, its inputs and the options that apply to it. Options that a verb does
// not have are refused, and no option may be abbreviated.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "study/schedule/progress.h"

namespace linkstudy {

struct CommandLine {
  std::string verb;
  std::vector<std::string> inputs;
  std::string command;  // as typed, for the provenance
  bool help = false;

  std::optional<std::string> output;
  std::vector<std::string> set;  // path=value
  std::optional<std::uint64_t> seed;
  std::optional<int> batch;
  std::optional<std::string> on_failure;    // record, abort
  std::optional<std::string> max_failures;  // N or P%
  std::optional<double> timeout_s;
  std::optional<double> walltime_s;
  bool fresh = false;
  bool json = false;
  bool markdown = false;
  bool traces = false;
  bool slurm = false;
  std::string progress = "auto";
  std::string log_level = "info";
  std::optional<std::string> csv;
  std::optional<std::string> signals;  // a,b
  std::string format = "csv";
  std::optional<std::string> h5;
  std::vector<std::string> drives;  // joint.NAME or joint.NAME=FROM:TO
  std::optional<std::string> from;  // of the driven coordinate, with or without unit
  std::optional<std::string> to;
  std::optional<std::string> speed;
  std::optional<int> positions;
};

// Something typed wrong: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws UsageError. The verb "version" or "help" stands for --version and --help alone.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

// How to use the program, or one verb.
std::string usage();
std::string usage_of(const std::string& verb);

}  // namespace linkstudy
