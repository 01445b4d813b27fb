// Bytes of the journal. A journal is a header and then records:
//   header   magic "linkstJ\n" (8), version (4), input SHA-256 as 64 digits, CRC-32 of these (4)
//   record   length of the payload (4), CRC-32 of length and payload (4), payload
//   payload  kind (1), then the fields in the order of their struct, encoded as in record/bytes.h
// The checksum covers the length, so that a tail of zeros is no record.
// Version 3 has two kinds more: reference runs, and provenance with the job. Version 2 can be read
// but not continued.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "study/store/results.h"

namespace linkstudy {

inline constexpr std::uint32_t kJournalVersion = 3;
inline constexpr std::uint32_t kOldestJournalVersion = 2;
inline constexpr std::size_t kJournalHeaderSize = 80;

using JournalRecord =
    std::variant<Evaluation, TraceSet, NamedText, ProvenanceRow, StudyDescription, StoredReference>;

// Header of a journal of the input with this digest (64 digits).
std::string encode_header(std::string_view input_sha256);

enum class HeaderState { complete, torn, foreign, damaged, other_version };
struct JournalHeader {
  HeaderState state = HeaderState::torn;
  std::uint32_t version = 0;
  std::string input_sha256;
};
// torn: a beginning of a header and nothing else, left by a run killed at once.
JournalHeader decode_header(std::string_view bytes);

// A whole record: length, checksum, payload.
std::string encode_record(const JournalRecord& record);

// The payload of the record at the start of `bytes`; empty when it is torn or damaged.
std::string_view next_payload(std::string_view bytes);
inline constexpr std::size_t kRecordPrefixSize = 8;

// The longest payload.
inline constexpr std::uint64_t kMostRecordBytes = 0xffffffff;

// Throws StoreError on a payload of an unknown kind or shape (it was written so: its sum is right).
JournalRecord decode_payload(std::string_view payload);

}  // namespace linkstudy
