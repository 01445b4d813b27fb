// Parts of model_rows() and of other tables.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/config/key.h"

namespace linkstudy {

// format, kind and name, with which every file opens.
void add_file_rows(std::vector<KeyRow>& rows, const std::string& kind);

// Pose of a frame: a position and one of four ways to say a rotation.
void add_frame_rows(std::vector<KeyRow>& rows, const std::string& path);

void add_flexible_rows(std::vector<KeyRow>& rows);

// Effect where a switch holds one of some words (key.h).
inline Effect acts_where(std::string key, std::vector<std::string> words, std::string needs = {}) {
  return {std::move(key), std::move(words), std::move(needs), false};
}

// The same of what is written for the switch to choose from.
inline Effect stands_by(std::string key, std::vector<std::string> words) {
  return {std::move(key), std::move(words), {}, true};
}

// Of a table with a key `enabled`.
inline Effect when_enabled(const std::string& path) {
  return stands_by(path + ".enabled", {"true"});
}

// The law of LuGre, in a table of its own.
void add_friction_rows(std::vector<KeyRow>& rows, const std::string& path);

void add_clearance_rows(std::vector<KeyRow>& rows);
void add_kinematics_rows(std::vector<KeyRow>& rows);
void add_closure_rows(std::vector<KeyRow>& rows);

}  // namespace linkstudy
