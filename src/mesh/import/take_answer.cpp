#include "mesh/import/take_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mesh/import/read_answer.h"

namespace sdf_ccd {
namespace {

constexpr std::uint64_t kMaxReason = 1000;               // bytes
constexpr std::size_t kReadSize = std::size_t{1} << 16;  // elements; memory grows only with the data received

/// Replaces control and non-ASCII characters, so that text from a hostile file is safe for log and terminal.
std::string printable(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

class AnswerReader {
 public:
  AnswerReader(const ByteSource& source, const ReadLimits& limits) : source_(source), limits_(limits) {}

  ReadMesh read() {
    ReadAnswer answer;
    take(reinterpret_cast<char*>(&answer), sizeof answer);
    if (answer.magic != ReadAnswer::kMagic) throw std::runtime_error("the reader is of another version, or damaged");
    if (answer.reason_bytes > 0) throw std::runtime_error(takeReason(answer.reason_bytes));
    // The reader's memory limit bounds the size of its answer too.
    const std::uint64_t most = std::min<std::uint64_t>(limits_.memory, std::numeric_limits<int>::max());
    if (answer.vertices > most || answer.triangles > most ||
        answer.vertices * sizeof(Vector3d) + answer.triangles * sizeof(Vector3i) > limits_.memory) {
      throw std::runtime_error(tooMuchMemory(limits_));
    }
    ReadMesh result;
    result.resolution = answer.resolution;
    if (!std::isfinite(result.resolution)) throw std::runtime_error("the reader's answer is damaged");
    takeAll(result.mesh.vertices, answer.vertices);
    takeAll(result.mesh.triangles, answer.triangles);
    try {
      validate(result.mesh);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(error.what());
    }
    return result;
  }

 private:
  void take(char* to, std::size_t size) {
    while (size > 0) {
      const std::size_t count = source_(to, size);
      to += count;
      size -= count;
    }
  }

  template <class Element>
  void takeAll(std::vector<Element>& elements, std::uint64_t count) {
    static_assert(sizeof(Element) == 3 * sizeof(typename Element::Scalar), "no padding");
    while (elements.size() < count) {
      const std::size_t have = elements.size();
      elements.resize(have + std::min<std::size_t>(kReadSize, count - have));
      take(reinterpret_cast<char*>(elements.data() + have), (elements.size() - have) * sizeof(Element));
    }
  }

  std::string takeReason(std::uint64_t size) {
    std::string reason(std::min(size, kMaxReason), '\0');
    take(&reason[0], reason.size());
    return printable(reason);
  }

  const ByteSource& source_;
  const ReadLimits& limits_;
};

}  // namespace

ReadMesh receiveAnswer(const ByteSource& source, const ReadLimits& limits) {
  return AnswerReader(source, limits).read();
}

std::string tooMuchMemory(const ReadLimits& limits) {
  return "the reader was stopped: it needed more than " + std::to_string(limits.memory >> 20) + " MiB";
}

}  // namespace sdf_ccd
