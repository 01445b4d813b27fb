#include "study/record/bytes.h"

namespace linkstudy {

void ByteWriter::put(std::string_view text) {
  put(std::uint64_t{text.size()});
  bytes_.append(text);
}

std::string_view ByteReader::take(std::size_t count) {
  if (count > bytes_.size()) throw std::out_of_range("record ends before its content");
  const std::string_view taken = bytes_.substr(0, count);
  bytes_.remove_prefix(count);
  return taken;
}

std::size_t ByteReader::get_count(std::size_t item_size) {
  const auto count = read<std::uint64_t>();
  if (count > bytes_.size() / item_size) {
    throw std::out_of_range("record announces more items than it holds");
  }
  return count;
}

}  // namespace linkstudy
