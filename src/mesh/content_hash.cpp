#include "mesh/content_hash.h"

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <openssl/evp.h>

namespace sdf_ccd {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    require(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  void add(const void* data, std::size_t bytes) { require(EVP_DigestUpdate(context_.get(), data, bytes) == 1); }

  template <class T>
  void add(const std::vector<T>& values) {
    add(values.data(), values.size() * sizeof(T));
  }

  std::string digits() {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned bytes = 0;
    require(EVP_DigestFinal_ex(context_.get(), digest, &bytes) == 1);
    std::string text;
    unsigned left = 0, bits = 0;  // of the digest that are not in the text yet
    for (unsigned i = 0; i < bytes; ++i) {
      left = left << 8 | digest[i];
      for (bits += 8; bits >= 5; bits -= 5) text += kDigits[left >> (bits - 5) & 31];
    }
    return bits > 0 ? text + kDigits[left << (5 - bits) & 31] : text;
  }

 private:
  static constexpr char kDigits[] = "0123456789abcdefghijklmnopqrstuv";

  static void require(bool is_done) {
    if (!is_done) throw std::runtime_error("SHA-256 is not available from libcrypto");
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

template <class T>
bool areIdentical(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace

std::string contentHash(const TriangleMesh& mesh, const std::vector<double>& numbers) {
  Sha256 hash;
  const std::uint64_t counts[] = {mesh.vertices.size(), mesh.triangles.size(), numbers.size()};
  hash.add(counts, sizeof counts);
  hash.add(mesh.vertices);
  hash.add(mesh.triangles);
  hash.add(numbers);
  return hash.digits();
}

bool areIdentical(const TriangleMesh& a, const TriangleMesh& b) {
  return areIdentical(a.vertices, b.vertices) && areIdentical(a.triangles, b.triangles);
}

}  // namespace sdf_ccd
