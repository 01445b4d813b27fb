// The one byte encoding of this program: integers little-endian in fixed widths, doubles as their
// 64 IEEE-754 bits, texts as a 64-bit length and their bytes, lists as a 64-bit count and their
// items. The digest hashes it, the journal stores it, ranks send it to each other; it does not
// depend on the machine's byte order or on the size of its types.
//
// A record states its members once, for writing and reading:
//   void visit_members(auto& archive, Like<Point> auto& point) { archive(point.id, point.values); }
// and is then an item of an archive like any other. `archive.template as<std::uint8_t>(member)`
// chooses the width of an enumeration or of an int.
#pragma once

#include <boost/endian/conversion.hpp>
#include <concepts>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace linkstudy {

// T or const T.
template <class U, class T>
concept Like = std::same_as<std::remove_const_t<U>, T>;

template <class T>
concept PlainNumber = std::is_arithmetic_v<T>;

class ByteWriter {
 public:
  ByteWriter() = default;
  // Continues behind these bytes.
  explicit ByteWriter(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class... Items>
  void operator()(const Items&... items) {
    (put(items), ...);
  }

  template <class Wire>
  void as(const auto& item, std::size_t = 0) {
    put(static_cast<Wire>(item));
  }

  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }
  void clear() { bytes_.clear(); }

 private:
  template <PlainNumber Number>
  void put(Number number) {
    unsigned char wire[sizeof number];
    boost::endian::endian_store<Number, sizeof number, boost::endian::order::little>(wire, number);
    bytes_.append(reinterpret_cast<const char*>(wire), sizeof wire);
  }
  void put(std::string_view text);
  void put(const std::string& text) { put(std::string_view(text)); }
  template <class Item>
  void put(const std::vector<Item>& items) {
    put(std::uint64_t{items.size()});
    for (const Item& item : items) put(item);
  }
  template <class Record>
  requires(!PlainNumber<Record>) void put(const Record& record) { visit_members(*this, record); }

  std::string bytes_;
};

// Reads what ByteWriter wrote, in the same order. Throws std::out_of_range past the end, and where
// the bytes are none of that.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class... Items>
  void operator()(Items&... items) {
    (get(items), ...);
  }

  // Refuses what is not below `end`.
  template <class Wire, class Item>
  void as(Item& item, std::size_t end = std::numeric_limits<std::size_t>::max()) {
    Wire wire{};
    get(wire);
    if (end != std::numeric_limits<std::size_t>::max() && static_cast<std::size_t>(wire) >= end) {
      throw std::out_of_range("record holds an unknown word");
    }
    item = static_cast<Item>(wire);
  }

  template <class Item>
  Item read() {
    Item item{};
    get(item);
    return item;
  }

  bool at_end() const { return bytes_.empty(); }

 private:
  template <PlainNumber Number>
  void get(Number& number) {
    number = boost::endian::endian_load<Number, sizeof number, boost::endian::order::little>(
        reinterpret_cast<const unsigned char*>(take(sizeof number).data()));
  }
  void get(std::string& text) { text = take(read<std::uint64_t>()); }
  template <class Item>
  void get(std::vector<Item>& items) {
    items.resize(get_count(PlainNumber<Item> ? sizeof(Item) : 1));
    for (Item& item : items) get(item);
  }
  template <class Record>
  requires(!PlainNumber<Record>) void get(Record& record) { visit_members(*this, record); }

  // Refused when so many items cannot follow, so that a damaged count never turns into a huge
  // allocation.
  std::size_t get_count(std::size_t item_size);
  std::string_view take(std::size_t count);

  std::string_view bytes_;
};

template <class Variant>
Variant make_alternative(std::size_t index) {
  Variant made;
  const auto try_all = [&]<std::size_t... I>(std::index_sequence<I...>) {
    return ((I == index && (made.template emplace<I>(), true)) || ...);
  };
  if (!try_all(std::make_index_sequence<std::variant_size_v<Variant>>())) {
    throw std::out_of_range("record holds an unknown kind of value");
  }
  return made;
}

// The number of the alternative, then what it holds.
template <class Archive, class Variant>
void visit_variant(Archive& archive, Variant& variant) {
  auto index = static_cast<std::uint8_t>(variant.index());
  archive(index);
  if constexpr (!std::is_const_v<Variant>) variant = make_alternative<Variant>(index);
  std::visit([&](auto& held) { archive(held); }, variant);
}

template <class Record>
std::string to_bytes(const Record& record) {
  ByteWriter out;
  out(record);
  return out.take();
}

// Throws std::out_of_range where the bytes are none of to_bytes<Record>.
template <class Record>
Record from_bytes(std::string_view bytes) {
  ByteReader in(bytes);
  Record record = in.read<Record>();
  if (!in.at_end()) throw std::out_of_range("a record with something behind it");
  return record;
}

}  // namespace linkstudy
