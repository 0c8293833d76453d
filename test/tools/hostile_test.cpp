#include <sys/resource.h>

#include <chrono>

#include "oracle/hostile_files.h"
#include "tools/tool_run.h"

namespace sdf_ccd::hostile_test {

constexpr double kSeconds = 5.0;  // for a loaded computer; usually a hundredth of it
constexpr long kKilobytes = 200'000;

class Hostile : public test::ToolTest {
 protected:
  void expectRefusedCheaply(const std::string& option, const std::string& name) {
    const auto start = std::chrono::steady_clock::now();
    expectRefused("build " + option + " '" + test::hostilePath(name) + "' --out made", name);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), kSeconds) << name;
    struct rusage usage;
    ::getrusage(RUSAGE_CHILDREN, &usage);  // maximum over all children so far, readers included
    EXPECT_LT(usage.ru_maxrss, kKilobytes) << name;
  }
};

TEST_F(Hostile, MeshesAreRefusedWithAReason) {
  for (const std::string& name : test::hostileMeshes()) expectRefusedCheaply("--mesh", name);
}

TEST_F(Hostile, MapsAreRefusedWithAReason) {
  expectRefusedCheaply("--octomap", "octomap_19b_2GB.bt");
  expectRefused("build --octomap /dev/zero --out made", "/dev/zero: is not a regular file");
}

TEST_F(Hostile, FormatIsWhatTheNameSays) {
  for (const std::string& name : test::hostileMeshes()) {
    for (const char* ending : {"stl", "obj", "off", "ply", "dae"}) {
      const std::string copy = name + "." + ending;
      write(copy, test::readText(test::hostilePath(name)));
      if (name.substr(name.size() - 3) != ending) expectRefused("build --mesh " + copy + " --out made", copy);
    }
  }
}

}  // namespace sdf_ccd::hostile_test
