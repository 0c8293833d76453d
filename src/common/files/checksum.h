#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <tbb/parallel_for.h>
#include <xxhash.h>

namespace sdf_ccd {

/// XXH64 of the XXH64 of each piece, so that pieces can be read at the same time. Before version 0.8, which
/// Ubuntu 20.04 does not have, the faster XXH3 was not final.
class Checksum {
 public:
  /// @param piece  called with (from, bytes) for each piece; returns its data.
  template <class Piece>
  static std::uint64_t of(std::size_t bytes, Piece piece) {
    std::vector<std::uint64_t> pieces((bytes + kPiece - 1) / kPiece);
    tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
      const std::size_t from = i * kPiece, count = std::min(kPiece, bytes - from);
      pieces[i] = XXH64(piece(from, count), count, 0);
    });
    return of(pieces);
  }

  Checksum() : state_(XXH64_createState(), &XXH64_freeState) { XXH64_reset(state_.get(), 0); }

  void add(const void* data, std::size_t bytes) {
    for (const char* from = static_cast<const char*>(data); bytes > 0;) {
      const std::size_t part = std::min(bytes, kPiece - in_piece_);
      XXH64_update(state_.get(), from, part);
      from += part;
      bytes -= part;
      in_piece_ += part;
      if (in_piece_ == kPiece) endPiece();
    }
  }
  std::uint64_t digest() {
    if (in_piece_ > 0) endPiece();
    return of(pieces_);
  }

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 20;

  static std::uint64_t of(const std::vector<std::uint64_t>& pieces) {
    return XXH64(pieces.data(), pieces.size() * sizeof(std::uint64_t), 0);
  }
  void endPiece() {
    pieces_.push_back(XXH64_digest(state_.get()));
    XXH64_reset(state_.get(), 0);
    in_piece_ = 0;
  }

  std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state_;
  std::vector<std::uint64_t> pieces_;
  std::size_t in_piece_ = 0;
};

}  // namespace sdf_ccd
