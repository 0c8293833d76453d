#include "ros/bag/read_bag.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include <ros/time.h>

namespace sdf_ccd {
namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
const std::string kBegin = "#ROSBAG V";  // of all format versions

[[noreturn]] void fail(const std::string& reason) {
  throw rosbag::BagFormatException(reason);
}

/// A record of format 2.0: named fields, and data of which only the place is kept.
class Record {
 public:
  enum Kind : char { kBagHeader = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6 };

  /// Reads the fields of the record at `at`. @param end  of the file [bytes].
  Record(std::istream& stream, std::uint64_t at, std::uint64_t end) : at_(at) {
    std::string fields(length(stream, at, end), '\0');
    stream.read(&fields[0], static_cast<std::streamsize>(fields.size()));
    data_ = at + 4 + fields.size();
    data_bytes_ = length(stream, data_, end);
    data_ += 4;
    while (!fields.empty()) {
      std::uint32_t bytes = 0;
      if (fields.size() >= 4) std::memcpy(&bytes, fields.data(), 4);
      const std::size_t is = fields.find('=', 4);
      if (bytes == 0 || bytes > fields.size() - 4 || is >= 4 + bytes) fail(place() + " is not readable");
      fields_[fields.substr(4, is - 4)] = fields.substr(is + 1, 4 + bytes - is - 1);
      fields.erase(0, 4 + bytes);
    }
  }

  Kind kind() const { return static_cast<Kind>(number<char>("op")); }
  std::uint64_t at() const { return at_; }
  std::uint64_t data() const { return data_; }
  std::uint32_t dataBytes() const { return data_bytes_; }
  std::uint64_t next() const { return data_ + data_bytes_; }
  std::string place() const { return "the record at byte " + std::to_string(at_); }

  template <class T>
  T number(const std::string& field) const {
    const auto found = fields_.find(field);
    if (found == fields_.end() || found->second.size() != sizeof(T)) fail(place() + " has no " + field);
    T value;
    std::memcpy(&value, found->second.data(), sizeof value);
    return value;
  }
  ros::Time time(const std::string& field) const {
    const auto both = number<std::uint64_t>(field);
    return ros::Time(static_cast<std::uint32_t>(both), static_cast<std::uint32_t>(both >> 32));
  }

 private:
  std::uint32_t length(std::istream& stream, std::uint64_t at, std::uint64_t end) const {
    std::uint32_t bytes = 0;
    stream.seekg(static_cast<std::streamoff>(at));
    if (at + 4 <= end) stream.read(reinterpret_cast<char*>(&bytes), 4);
    if (at + 4 > end || !stream || bytes > end - at - 4) fail(place() + " reaches beyond the file");
    return bytes;
  }

  std::uint64_t at_, data_ = 0;
  std::uint32_t data_bytes_ = 0;
  std::map<std::string, std::string> fields_;
};

/// What the index says about a chunk.
struct ChunkIndex {
  std::uint32_t bytes = 0;  ///< of the chunk, before compression
  ros::Time first = ros::TIME_MAX, last = ros::TIME_MIN;
};

void addIndex(std::istream& stream, const Record& record, ChunkIndex& chunk) {
  struct Entry {
    std::uint32_t seconds, nanoseconds, offset;
  };
  std::vector<Entry> entries(record.dataBytes() / sizeof(Entry));
  stream.seekg(static_cast<std::streamoff>(record.data()));
  stream.read(reinterpret_cast<char*>(entries.data()), static_cast<std::streamsize>(entries.size() * sizeof(Entry)));
  for (const Entry& entry : entries) {
    if (entry.offset >= chunk.bytes || entry.nanoseconds >= 1'000'000'000)
      fail(record.place() + " is an index of what its chunk does not hold");
    const ros::Time time(entry.seconds, entry.nanoseconds);
    chunk.first = std::min(chunk.first, time);
    chunk.last = std::max(chunk.last, time);
  }
}

}  // namespace

std::size_t requireSoundIndex(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string version;
  std::getline(stream, version);
  if (version != kBegin + "2.0") return kNoLimit;
  const std::uint64_t begin = version.size() + 1, end = std::filesystem::file_size(file);
  if (begin == end || Record(stream, begin, end).number<std::uint64_t>("index_pos") == 0) return kNoLimit;
  std::map<std::uint64_t, ChunkIndex> chunks;  // by their place in the file
  std::size_t largest = 0;
  for (std::uint64_t at = begin, of_chunk = 0; at < end;) {
    const Record record(stream, at, end);
    if (record.kind() == Record::kChunk) {
      of_chunk = at;
      chunks[at].bytes = record.number<std::uint32_t>("size");
      largest = std::max<std::size_t>(largest, chunks[at].bytes);
    } else if (record.kind() == Record::kIndex) {
      addIndex(stream, record, chunks[of_chunk]);
    } else if (record.kind() == Record::kChunkInfo) {
      const auto chunk = chunks.find(record.number<std::uint64_t>("chunk_pos"));
      if (chunk == chunks.end()) fail(record.place() + " is about a chunk that is not there");
      if (chunk->second.first < record.time("start_time") || chunk->second.last > record.time("end_time"))
        fail("the index has messages at times that their chunk at byte " + std::to_string(chunk->first) +
             " does not cover");
    }
    at = record.next();
  }
  return largest;
}

void requireBag(const std::string& file) {
  std::error_code missing;
  const std::filesystem::file_status status = std::filesystem::status(file, missing);
  if (std::filesystem::is_directory(status)) throw std::runtime_error(file + ": is a directory, not a bag");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw std::runtime_error(file + ": is not a regular file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + ": cannot be opened: " + std::strerror(errno));
  std::string begin(kBegin.size(), '\0');
  stream.read(&begin[0], static_cast<std::streamsize>(begin.size()));
  if (begin != kBegin) throw std::runtime_error(file + ": is not a bag");
}

}  // namespace sdf_ccd
