#include "study/store/journal_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/crc.hpp>

#include "study/record/evaluation_bytes.h"
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

void put(ByteWriter& out, const Evaluation& evaluation) {
  out.put_u8(static_cast<std::uint8_t>(Kind::evaluation));
  put_point(out, evaluation.point);
  put_cause(out, evaluation.status);
  out.put_text(evaluation.message);
  put_numbers(out, evaluation.responses);
  out.put_u32(evaluation.attempts);
  out.put_i64(evaluation.parent);
  out.put_f64(evaluation.wall_s);
  out.put_u32(static_cast<std::uint32_t>(evaluation.rank));
  out.put_text(evaluation.host);
}

Evaluation get_evaluation(ByteReader& in) {
  Evaluation evaluation;
  evaluation.point = get_point(in);
  evaluation.status = get_cause(in);
  evaluation.message = in.get_text();
  evaluation.responses = get_numbers(in);
  evaluation.attempts = in.get_u32();
  evaluation.parent = in.get_i64();
  evaluation.wall_s = in.get_f64();
  evaluation.rank = static_cast<std::int32_t>(in.get_u32());
  evaluation.host = in.get_text();
  return evaluation;
}

void put(ByteWriter& out, const TraceSet& set) {
  out.put_u8(static_cast<std::uint8_t>(Kind::traces));
  out.put_text(set.name);
  out.put_i64(set.evaluation);
  put_traces(out, set.traces);
}

TraceSet get_trace_set(ByteReader& in) {
  TraceSet set;
  set.name = in.get_text();
  set.evaluation = in.get_i64();
  set.traces = get_traces(in);
  return set;
}

void put(ByteWriter& out, const NamedText& text) {
  out.put_u8(static_cast<std::uint8_t>(Kind::text));
  out.put_text(text.name);
  out.put_text(text.text);
}

NamedText get_named_text(ByteReader& in) {
  NamedText text;
  text.name = in.get_text();
  text.text = in.get_text();
  return text;
}

void put(ByteWriter& out, const ProvenanceRow& row) {
  out.put_u8(static_cast<std::uint8_t>(Kind::provenance));
  out.put_text(row.event);
  out.put_f64(row.time_unix_s);
  out.put_u64(row.total);
  out.put_u32(row.ranks);
  out.put_text(row.host);
  out.put_text(row.program_version);
  out.put_text(row.git_revision);
  out.put_text(row.command);
  out.put_text(row.simd);
  out.put_u32(row.lanes);
  out.put_text(row.job);
  out.put_u32(row.restart);
}

ProvenanceRow get_provenance(ByteReader& in, Kind kind) {
  ProvenanceRow row;
  row.event = in.get_text();
  row.time_unix_s = in.get_f64();
  row.total = in.get_u64();
  row.ranks = in.get_u32();
  row.host = in.get_text();
  row.program_version = in.get_text();
  row.git_revision = in.get_text();
  row.command = in.get_text();
  row.simd = in.get_text();
  row.lanes = in.get_u32();
  if (kind == Kind::provenance_without_job) return row;
  row.job = in.get_text();
  row.restart = in.get_u32();
  return row;
}

void put(ByteWriter& out, const StudyDescription& description) {
  out.put_u8(static_cast<std::uint8_t>(Kind::description));
  out.put_text(description.name);
  out.put_text(description.kind);
  out.put_u64(description.seed);
  out.put_u64(description.parameters.size());
  for (const Parameter& parameter : description.parameters) {
    out.put_text(parameter.path);
    out.put_text(parameter.unit);
    out.put_text(parameter.long_name);
  }
  out.put_u64(description.responses.size());
  for (const Response& response : description.responses) {
    out.put_text(response.name);
    out.put_text(response.unit);
    out.put_text(response.long_name);
  }
}

StudyDescription get_description(ByteReader& in) {
  StudyDescription description;
  description.name = in.get_text();
  description.kind = in.get_text();
  description.seed = in.get_u64();
  description.parameters.resize(in.get_count(1));
  for (Parameter& parameter : description.parameters) {
    parameter.path = in.get_text();
    parameter.unit = in.get_text();
    parameter.long_name = in.get_text();
  }
  description.responses.resize(in.get_count(1));
  for (Response& response : description.responses) {
    response.name = in.get_text();
    response.unit = in.get_text();
    response.long_name = in.get_text();
  }
  return description;
}

void put(ByteWriter& out, const StoredReference& reference) {
  out.put_u8(static_cast<std::uint8_t>(Kind::reference));
  out.put_text(reference.name);
  out.put_text(reference.bytes);
}

StoredReference get_reference(ByteReader& in) {
  StoredReference reference;
  reference.name = in.get_text();
  reference.bytes = in.get_text();
  return reference;
}

JournalRecord get_record(ByteReader& in) {
  const std::uint8_t kind = in.get_u8();
  switch (static_cast<Kind>(kind)) {
    case Kind::evaluation:
      return get_evaluation(in);
    case Kind::traces:
      return get_trace_set(in);
    case Kind::text:
      return get_named_text(in);
    case Kind::provenance_without_job:
    case Kind::provenance:
      return get_provenance(in, static_cast<Kind>(kind));
    case Kind::description:
      return get_description(in);
    case Kind::reference:
      return get_reference(in);
  }
  throw StoreError(fmt::format("journal holds a record of the unknown kind {}", kind));
}

}  // namespace

std::string encode_header(std::string_view input_sha256) {
  if (input_sha256.size() != kDigestSize) {
    throw std::invalid_argument("an input digest has 64 hexadecimal digits");
  }
  ByteWriter version;
  version.put_u32(kJournalVersion);
  const std::string body =
      fmt::format("{}{}{}", kMagic, std::string_view(version.bytes()), input_sha256);
  ByteWriter sum;
  sum.put_u32(crc32(body));
  return body + sum.bytes();
}

JournalHeader decode_header(std::string_view bytes) {
  JournalHeader header;
  const std::size_t known = std::min(bytes.size(), kMagic.size());
  if (bytes.substr(0, known) != kMagic.substr(0, known)) {
    header.state = HeaderState::foreign;
    return header;
  }
  if (bytes.size() < kJournalHeaderSize) {
    return header;
  }
  const std::string_view body = bytes.substr(0, kJournalHeaderSize - 4);
  ByteReader in(bytes.substr(kMagic.size(), 4));
  header.version = in.get_u32();
  header.input_sha256 = body.substr(kMagic.size() + 4);
  ByteReader sum(bytes.substr(body.size(), 4));
  if (sum.get_u32() != crc32(body)) {
    header.state = HeaderState::damaged;
  } else {
    const bool is_known =
        header.version >= kOldestJournalVersion && header.version <= kJournalVersion;
    header.state = is_known ? HeaderState::complete : HeaderState::other_version;
  }
  return header;
}

std::string encode_record(const JournalRecord& record) {
  ByteWriter payload;
  std::visit([&](const auto& content) { put(payload, content); }, record);
  if (payload.bytes().size() > kMostRecordBytes) {
    throw StoreError("a record is larger than 4 GiB; ask for fewer or coarser time histories");
  }
  ByteWriter length;
  length.put_u32(static_cast<std::uint32_t>(payload.bytes().size()));
  ByteWriter sum;
  sum.put_u32(crc32(length.bytes(), payload.bytes()));
  return length.bytes() + sum.bytes() + payload.bytes();
}

std::string_view next_payload(std::string_view bytes) {
  if (bytes.size() < kRecordPrefixSize) {
    return {};
  }
  ByteReader prefix(bytes);
  const std::uint32_t length = prefix.get_u32();
  const std::uint32_t sum = prefix.get_u32();
  if (length > bytes.size() - kRecordPrefixSize) {
    return {};
  }
  const std::string_view payload = bytes.substr(kRecordPrefixSize, length);
  return crc32(bytes.substr(0, 4), payload) == sum ? payload : std::string_view{};
}

JournalRecord decode_payload(std::string_view payload) {
  ByteReader in(payload);
  try {
    JournalRecord record = get_record(in);
    if (in.at_end()) {
      return record;
    }
  } catch (const std::out_of_range&) {
  }
  throw StoreError("journal holds a record of another shape; was it written by another version?");
}

}  // namespace linkstudy
