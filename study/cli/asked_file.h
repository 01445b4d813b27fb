// A file that an option such as --csv asks for; "-" is standard output.
#pragma once

#include <optional>
#include <string>

#include "study/cli/command_line.h"

namespace linkstudy {

// Before the run that fills it: throws UsageError where it cannot be written.
void require_writable(const std::string& option, const std::optional<std::string>& path);

// Throws UsageError where the file is the input itself.
void require_other_file(const std::string& option, const std::optional<std::string>& path,
                        const std::string& input);

// What an earlier run wrote there must not pass for that of one that fails now. What is no regular
// file is left alone.
void remove_old(const std::optional<std::string>& path);

// To standard output, unless --json, --csv or --write-start has it.
void print_text(const CommandLine& line, const std::string& text);

void write_asked(const std::string& path, const std::string& text);

}  // namespace linkstudy
