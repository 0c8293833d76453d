#include "sdf_ccd/field/field_cache.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <xxhash.h>

#include "sdf_ccd/field/field_file.h"

namespace sdf_ccd {
namespace {

/// Held by the one process that builds a field; the kernel frees it if that process dies.
class FileLock {
 public:
  explicit FileLock(const std::string& path) : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) throw std::runtime_error(path + ": " + std::strerror(errno));
    while (flock(descriptor_, LOCK_EX) != 0) {
      if (errno == EINTR) continue;
      const std::string reason = std::strerror(errno);
      close(descriptor_);
      throw std::runtime_error(path + ": cannot lock: " + reason);
    }
  }
  ~FileLock() { close(descriptor_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

template <class T>
void append(XXH64_state_t* state, const T& value) {
  XXH64_update(state, &value, sizeof value);
}

std::uint64_t contentHash(const TriangleMesh& mesh, const FieldOptions& options, std::uint64_t seed) {
  XXH64_state_t* state = XXH64_createState();
  XXH64_reset(state, seed);
  append(state, mesh.vertices.size());
  XXH64_update(state, mesh.vertices.data(), mesh.vertices.size() * sizeof(Vector3d));
  XXH64_update(state, mesh.triangles.data(), mesh.triangles.size() * sizeof(Vector3i));
  append(state, options.cells.value_or(0));
  append(state, options.cell_size.value_or(0.0));
  append(state, options.max_error.value_or(0.0));
  append(state, options.band);
  const std::uint64_t hash = XXH64_digest(state);
  XXH64_freeState(state);
  return hash;
}

}  // namespace

FieldCache::FieldCache(std::string directory) : directory_(std::move(directory)) {}

std::string FieldCache::fileName(const TriangleMesh& mesh, const FieldOptions& options) {
  char name[48];
  std::snprintf(name, sizeof name, "%016llx%016llx.field",
                static_cast<unsigned long long>(contentHash(mesh, options, 1)),
                static_cast<unsigned long long>(contentHash(mesh, options, 2)));
  return name;
}

CachedField FieldCache::fieldFor(const TriangleMesh& mesh, const FieldOptions& options,
                                 const Progress& progress) const {
  if (directory_.empty()) return {buildField(mesh, options, progress), false, ""};
  validate(mesh);
  validate(options);
  const std::string path = directory_ + "/" + fileName(mesh, options);
  std::string warning;
  try {
    std::filesystem::create_directories(directory_);
    const FileLock lock(path + ".lock");
    if (std::filesystem::exists(path)) {
      try {
        return {loadField(path), true, ""};
      } catch (const std::runtime_error& error) {
        warning = std::string("built again: ") + error.what();
      }
    }
    CachedField built{buildField(mesh, options, progress), false, warning};
    try {
      saveField(built.field, path);
    } catch (const std::runtime_error& error) {
      built.warning = std::string("not kept: ") + error.what();
    }
    return built;
  } catch (const std::filesystem::filesystem_error& error) {
    warning = std::string("cache not used: ") + error.what();
  } catch (const std::runtime_error& error) {
    warning = std::string("cache not used: ") + error.what();
  }
  return {buildField(mesh, options, progress), false, warning};
}

}  // namespace sdf_ccd
