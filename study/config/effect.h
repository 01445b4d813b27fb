// Values that have no effect: where the switch that decides about them (`effects` of their rows in
// the key tables) stands elsewhere. One rule for all keys (study/README.md, "What has no effect").
#pragma once

#include "study/config/key.h"

namespace linkstudy {

// A value of the document and what takes its effect away.
struct Ineffective {
  std::string path;        // "closure.C.friction"
  Location at;             // where it is written
  std::string reason;      // "closure.C.model = 'cut' (model.toml:70:9)"
  std::string remedy;      // "it acts where closure.C.model = clearance"
  bool is_lost = false;    // no switch could give it an effect
  bool stands_by = false;  // it is there to be switched to

  std::string message() const { return path + " has no effect: " + reason; }
};

// What of a document, as written, has no effect; of a table without, not its parts too. `verb`:
// what the program does ("simulate", "study", ...), empty where it does nothing yet.
std::vector<Ineffective> find_ineffective(const Tree& document, const KeyNode& schema,
                                          const std::string& verb);

// The same of one path, written or not. Nothing when it has an effect, or names nothing.
std::optional<Ineffective> find_ineffective(const Tree& document, const KeyNode& schema,
                                            const std::string& path, const std::string& verb);

}  // namespace linkstudy
