// The one byte encoding of this program: integers little-endian in fixed widths, doubles as their
// 64 IEEE-754 bits, texts as a 64-bit length and their bytes. The digest hashes it, the journal
// stores it; neither depends on the machine's byte order or on the size of its types.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace linkstudy {

class ByteWriter {
 public:
  void put_u8(std::uint8_t value);
  void put_u32(std::uint32_t value);
  void put_u64(std::uint64_t value);
  void put_i64(std::int64_t value);
  void put_f64(double value);
  void put_text(std::string_view text);

  const std::string& bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

// Reads what ByteWriter wrote, in the same order. Throws std::out_of_range past the end.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint8_t get_u8();
  std::uint32_t get_u32();
  std::uint64_t get_u64();
  std::int64_t get_i64();
  double get_f64();
  std::string get_text();
  // A count of items that take at least item_size bytes each: refused when they cannot follow, so
  // that a damaged count never turns into a huge allocation.
  std::size_t get_count(std::size_t item_size);

  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view take(std::size_t count);

  std::string_view bytes_;
};

}  // namespace linkstudy
