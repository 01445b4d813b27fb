#include "study/record/base64.h"

#include <openssl/evp.h>

#include <bit>
#include <boost/endian/conversion.hpp>
#include <cstdint>
#include <vector>

namespace linkstudy {
namespace {

template <class Number>
std::string base64_of(std::vector<Number> numbers) {
  return base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

}  // namespace

std::string base64(std::string_view bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // EVP_EncodeBlock ends it with a zero
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

std::string base64_floats(std::span<const double> values) {
  std::vector<std::uint32_t> bits;
  bits.reserve(values.size());
  for (const double value : values) {
    const auto number = static_cast<float>(value);
    bits.push_back(boost::endian::native_to_little(std::bit_cast<std::uint32_t>(number)));
  }
  return base64_of(std::move(bits));
}

std::string base64_indices(std::span<const std::uint32_t> values) {
  std::vector<std::uint32_t> bits(values.begin(), values.end());
  for (std::uint32_t& one : bits) boost::endian::native_to_little_inplace(one);
  return base64_of(std::move(bits));
}

}  // namespace linkstudy
