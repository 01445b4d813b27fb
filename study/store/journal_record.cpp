#include "study/store/journal_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/crc.hpp>

#include "study/record/bytes.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

constexpr std::string_view kMagic = "linkstJ\n";
constexpr std::size_t kDigestSize = 64;

enum class Kind : std::uint8_t {
  evaluation = 1,
  traces,
  text,
  provenance_without_job,  // version 2
  description,
  reference,
  provenance
};

std::uint32_t crc32(std::string_view first, std::string_view second = {}) {
  boost::crc_32_type crc;
  crc.process_bytes(first.data(), first.size());
  crc.process_bytes(second.data(), second.size());
  return crc.checksum();
}

Kind kind_of(const Evaluation&) {
  return Kind::evaluation;
}
Kind kind_of(const TraceSet&) {
  return Kind::traces;
}
Kind kind_of(const NamedText&) {
  return Kind::text;
}
Kind kind_of(const ProvenanceRow&) {
  return Kind::provenance;
}
Kind kind_of(const StudyDescription&) {
  return Kind::description;
}
Kind kind_of(const StoredReference&) {
  return Kind::reference;
}

JournalRecord get_record(ByteReader& in) {
  const auto kind = in.read<std::uint8_t>();
  switch (static_cast<Kind>(kind)) {
    case Kind::evaluation:
      return in.read<Evaluation>();
    case Kind::traces:
      return in.read<TraceSet>();
    case Kind::text:
      return in.read<NamedText>();
    case Kind::provenance_without_job: {
      ProvenanceRow row;
      visit_without_job(in, row);
      return row;
    }
    case Kind::provenance:
      return in.read<ProvenanceRow>();
    case Kind::description:
      return in.read<StudyDescription>();
    case Kind::reference:
      return in.read<StoredReference>();
  }
  throw StoreError(fmt::format("journal holds a record of the unknown kind {}", kind));
}

}  // namespace

std::string encode_header(std::string_view input_sha256) {
  if (input_sha256.size() != kDigestSize) {
    throw std::invalid_argument("an input digest has 64 hexadecimal digits");
  }
  const std::string body = fmt::format("{}{}{}", kMagic, to_bytes(kJournalVersion), input_sha256);
  return body + to_bytes(crc32(body));
}

JournalHeader decode_header(std::string_view bytes) {
  JournalHeader header;
  const std::size_t known = std::min(bytes.size(), kMagic.size());
  if (bytes.substr(0, known) != kMagic.substr(0, known)) {
    header.state = HeaderState::foreign;
    return header;
  }
  if (bytes.size() < kJournalHeaderSize) return header;
  const std::string_view body = bytes.substr(0, kJournalHeaderSize - 4);
  header.version = from_bytes<std::uint32_t>(bytes.substr(kMagic.size(), 4));
  header.input_sha256 = body.substr(kMagic.size() + 4);
  if (from_bytes<std::uint32_t>(bytes.substr(body.size(), 4)) != crc32(body)) {
    header.state = HeaderState::damaged;
  } else {
    const bool is_known =
        header.version >= kOldestJournalVersion && header.version <= kJournalVersion;
    header.state = is_known ? HeaderState::complete : HeaderState::other_version;
  }
  return header;
}

std::string encode_record(const JournalRecord& record) {
  ByteWriter out;
  std::visit(
      [&](const auto& content) {
        out.as<std::uint8_t>(kind_of(content));
        out(content);
      },
      record);
  const std::string& payload = out.bytes();
  if (payload.size() > kMostRecordBytes) {
    throw StoreError("a record is larger than 4 GiB; ask for fewer or coarser time histories");
  }
  const std::string length = to_bytes(static_cast<std::uint32_t>(payload.size()));
  return length + to_bytes(crc32(length, payload)) + payload;
}

std::string_view next_payload(std::string_view bytes) {
  if (bytes.size() < kRecordPrefixSize) return {};
  ByteReader prefix(bytes);
  const auto length = prefix.read<std::uint32_t>();
  const auto sum = prefix.read<std::uint32_t>();
  if (length > bytes.size() - kRecordPrefixSize) return {};
  const std::string_view payload = bytes.substr(kRecordPrefixSize, length);
  return crc32(bytes.substr(0, 4), payload) == sum ? payload : std::string_view{};
}

JournalRecord decode_payload(std::string_view payload) {
  ByteReader in(payload);
  try {
    JournalRecord record = get_record(in);
    if (in.at_end()) return record;
  } catch (const std::out_of_range&) {
  }
  throw StoreError("journal holds a record of another shape; was it written by another version?");
}

}  // namespace linkstudy
