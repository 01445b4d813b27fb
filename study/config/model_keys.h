// Parts of model_rows().
#pragma once

#include <string>
#include <vector>

#include "study/config/key.h"

namespace linkstudy {

// Pose of a frame: a position and one of four ways to say a rotation.
void add_frame_rows(std::vector<KeyRow>& rows, const std::string& path);

void add_closure_rows(std::vector<KeyRow>& rows);

}  // namespace linkstudy
