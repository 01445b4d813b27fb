// Numbers in texts: bytes in base64 (RFC 4648), by OpenSSL.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace linkstudy {

std::string base64(std::string_view bytes);

// Of 32-bit numbers, little-endian: seven digits are what a drawing needs. What is beyond them is
// infinite, NaN stays.
std::string base64_floats(std::span<const double> values);
std::string base64_indices(std::span<const std::uint32_t> values);

}  // namespace linkstudy
