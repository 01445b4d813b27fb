#include "study/record/bytes.h"

#include <bit>
#include <stdexcept>

namespace linkstudy {
namespace {

template <class Unsigned>
void put_little_endian(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i) & 0xffu));
  }
}

template <class Unsigned>
Unsigned little_endian(std::string_view bytes) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    value |= static_cast<Unsigned>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return value;
}

}  // namespace

void ByteWriter::put_u8(std::uint8_t value) {
  bytes_.push_back(static_cast<char>(value));
}
void ByteWriter::put_u32(std::uint32_t value) {
  put_little_endian(bytes_, value);
}
void ByteWriter::put_u64(std::uint64_t value) {
  put_little_endian(bytes_, value);
}
void ByteWriter::put_i64(std::int64_t value) {
  put_u64(static_cast<std::uint64_t>(value));
}
void ByteWriter::put_f64(double value) {
  put_u64(std::bit_cast<std::uint64_t>(value));
}

void ByteWriter::put_text(std::string_view text) {
  put_u64(text.size());
  bytes_.append(text);
}

std::string_view ByteReader::take(std::size_t count) {
  if (count > bytes_.size()) {
    throw std::out_of_range("record ends before its content");
  }
  const std::string_view taken = bytes_.substr(0, count);
  bytes_.remove_prefix(count);
  return taken;
}

std::uint8_t ByteReader::get_u8() {
  return static_cast<std::uint8_t>(take(1).front());
}
std::uint32_t ByteReader::get_u32() {
  return little_endian<std::uint32_t>(take(4));
}
std::uint64_t ByteReader::get_u64() {
  return little_endian<std::uint64_t>(take(8));
}
std::int64_t ByteReader::get_i64() {
  return static_cast<std::int64_t>(get_u64());
}
double ByteReader::get_f64() {
  return std::bit_cast<double>(get_u64());
}
std::string ByteReader::get_text() {
  return std::string(take(get_u64()));
}

std::size_t ByteReader::get_count(std::size_t item_size) {
  const std::uint64_t count = get_u64();
  if (count > bytes_.size() / item_size) {
    throw std::out_of_range("record announces more items than it holds");
  }
  return count;
}

}  // namespace linkstudy
