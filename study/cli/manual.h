// What is installed beside the program for its users, written from the verbs, the options and the
// keys: nothing is said twice.
#pragma once

#include <string>

namespace linkstudy {

// man 1 linkstudy (verbs and options) or man 5 linkstudy (keys of the input files), in roff.
std::string manual_page(int section);

// Completion for bash: verbs, their options and the words of these, keys for describe and --set.
std::string bash_completion();

}  // namespace linkstudy
