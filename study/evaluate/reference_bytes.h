// A finished reference run as bytes: kept in the journal so that no later start repeats it, and
// sent from rank 0 to the other ranks.
#pragma once

#include <string>
#include <string_view>

#include "study/metrics/reference_record.h"

namespace linkstudy {

std::string encode_reference(const ReferenceRecord& record);

// Throws std::out_of_range where the bytes are none of encode_reference.
ReferenceRecord decode_reference(std::string_view bytes);

}  // namespace linkstudy
