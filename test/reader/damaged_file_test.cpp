// Damaged files, parsed in the test's own process: a crash here would also crash the confined reader. DAE is read by
// that one, as users read it.
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "mesh/reader/octree_file.h"
#include "mesh/reader/parse_mesh.h"
#include "mesh/reader/parse_octomap.h"
#include "oracle/files.h"
#include "oracle/hostile_files.h"
#include "oracle/mesh_bytes.h"
#include "oracle/shapes.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::damaged_file_test {

struct File {
  std::string format;
  std::string bytes;
};

std::vector<File> files() {
  const TriangleMesh box = test::boxMesh({1, 2, 3});
  return {{"stl", test::binaryStl(box, "binary")},
          {"stl", test::asciiStl(box)},
          {"obj", test::obj(box)},
          {"off", test::off(box)},
          {"ply", test::ply(box)},
          {"ply", test::binaryPly(box, false)},
          {"ply", test::binaryPly(box, true)},
          {"dae", test::dae(box, "<unit meter=\"1\"/>",
                            std::string("<node id=\"n\"><translate>1 2 3</translate>") + test::kDaeInstance +
                                "</node><node><instance_node url=\"#n\"/></node>")}};
}

enum class Outcome { kMesh, kRefused };

/// Of so many attempts on another format, one is made on DAE: it starts a process each time.
std::size_t oneOf(const File& file) {
  return file.format == "dae" ? 101 : 1;
}

/// Parses a file. Whatever its bytes, it must give a valid mesh or an exception with a message.
Outcome read(const File& file) {
  try {
    validate(file.format == "dae" ? parseMesh(file.bytes, "a.dae") : parseMeshUnconfined(file.bytes, file.format));
    return Outcome::kMesh;
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()), "");
    return Outcome::kRefused;
  }
}

TEST(DamagedFile, CutAnywhere) {
  for (const File& file : files()) {
    EXPECT_EQ(read(file), Outcome::kMesh) << file.format;
    int meshes = 0;
    // A text may still be complete without its last bytes.
    for (std::size_t length = 0; length + 10 < file.bytes.size(); length += oneOf(file)) {
      meshes += read({file.format, file.bytes.substr(0, length)}) == Outcome::kMesh;
    }
    if (file.format == "obj") continue;  // OBJ does not announce its number of elements
    EXPECT_EQ(meshes, 0) << file.format;
  }
}

TEST(DamagedFile, EveryBitFlipped) {
  for (const File& file : files()) {
    File damaged = file;
    for (std::size_t i = 0; i < file.bytes.size(); ++i) {
      for (int bit = 0; bit < 8; ++bit) {
        if ((8 * i + static_cast<std::size_t>(bit)) % oneOf(file) != 0) continue;
        damaged.bytes[i] = static_cast<char>(file.bytes[i] ^ (1 << bit));
        read(damaged);
      }
      damaged.bytes[i] = file.bytes[i];
    }
  }
}

TEST(DamagedFile, NumbersAndWordsReplaced) {
  std::mt19937_64 random(1);
  const std::vector<std::string> words = {"-1",      "4294967295", "2147483647", "18446744073709551616",
                                          "1e308",   "nan",        "inf",        "0",
                                          "0x10",    "\"",         "#n",         "<node>",
                                          "f",       "\n",         "list",       "element face 4000000",
                                          "9999999", "\\"};
  for (const File& file : files()) {
    for (int round = 0; round < 4000 / static_cast<int>(oneOf(file)); ++round) {
      File damaged = file;
      for (int hit = 0; hit < 1 + round % 3; ++hit) {
        const std::size_t at = random() % damaged.bytes.size();
        damaged.bytes.replace(at, random() % 6, words[random() % words.size()]);
      }
      read(damaged);
    }
  }
}

TEST(DamagedFile, EveryFormatReadsEveryOther) {
  std::vector<std::string> contents;
  for (const File& file : files()) contents.push_back(file.bytes);
  for (const std::string& name : test::hostileMeshes()) {
    contents.push_back(test::readText(test::hostilePath(name)));
    EXPECT_FALSE(contents.back().empty()) << name;
  }
  for (const std::string& bytes : contents) {
    for (const char* format : {"stl", "obj", "off", "ply", "dae", "blend", ""}) read({format, bytes});
    try {
      parseOctomapUnconfined(bytes, 1 << 29);
      ADD_FAILURE() << "no map";
    } catch (const std::exception&) {
    }
  }
}

/// OctoMap reads "id OcTree\vsize 24" as two entries, and takes "data" within a line as the end of the header.
TEST(DamagedFile, OctomapHeadsMeanTheSameToWhoChecksAndWhoReads) {
  const std::string node = {0, 0, 0, 0, 0}, parent = {0, 0, 0, 0, 1};
  const std::string whole = "# Octomap OcTree file\nid OcTree\nsize 2\nres 0.1\n";
  EXPECT_NO_THROW(checkOctreeFile(whole + "data\n" + parent + node));
  for (const std::string& head :
       {whole + "# data\n", whole + "x data\n", whole + "id OcTree\vsize 900000 data\n", whole + "res 0.1\vdata\n"}) {
    // The nodes that OctoMap would read after the earlier `data` have all children, without end.
    const std::string bytes = head + std::string(64, '\xff') + "\ndata\n" + parent + node;
    const OctreeFile file = checkOctreeFile(bytes);
    const std::string plain = withPlainHead(file, bytes);
    EXPECT_EQ(plain.substr(plain.size() - 10), parent + node);
    EXPECT_EQ(plain.find("data"), plain.size() - 15);
    try {
      parseOctomapUnconfined(bytes, 1 << 29);
    } catch (const std::exception&) {
    }
  }
}

TEST(DamagedFile, HugeCountsCostNothing) {
  for (const char* count : {"4000000000", "18446744073709551615", "1e18", "-1", "nan", "99999999999999999999999"}) {
    const std::string number = count;
    EXPECT_EQ(read({"off", "OFF\n" + number + " 1 0\n0 0 0\n"}), Outcome::kRefused);
    EXPECT_EQ(read({"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n" + number + " 0 1 2\n"}), Outcome::kRefused);
    EXPECT_EQ(read({"obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9" + number + "\n"}), Outcome::kRefused);
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n";
    EXPECT_EQ(read({"ply", head + "element face " + number + "\nend_header\n0 0 1 0 0 1\n"}), Outcome::kRefused);
    EXPECT_EQ(read({"ply", head + "element face 1\nproperty list int int vertex_index\nend_header\n0 0 1 0 0 1\n" +
                               number + " 0 1 2\n"}),
              Outcome::kRefused);
  }
}

TEST(DamagedFile, NodesThatContainThemselvesInWhateverWay) {
  const TriangleMesh box = test::boxMesh({1, 1, 1});
  for (const char* nodes :
       {"<node id=\"n\"><instance_node url=\"#n\"/></node>",
        "<node id=\"n\"><node><node><instance_node url=\"#n\"/></node></node></node>",
        "<node id=\"n\"><instance_geometry url=\"#n\"/></node>",
        "<node id=\"n\"><instance_controller url=\"#n\"/></node>", "<node id=\"n\"><instance_node url=\"#s\"/></node>",
        "<node id=\"n\"><instance_node url=\"#m\"/></node><node id=\"m\"><instance_node url=\"#n\"/></node>",
        "<node><instance_node url=\"other.dae#n\"/></node>", "<node><instance_node/></node>"}) {
    EXPECT_EQ(read({"dae", test::dae(box, "", nodes)}), Outcome::kRefused) << nodes;
  }
}

}  // namespace sdf_ccd::damaged_file_test
