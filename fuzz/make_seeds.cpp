// Writes the initial corpus of each fuzz target into a folder: small valid inputs, and those that once broke a reader.
// usage: fuzz_seeds FOLDER SOURCE_FOLDER

#include <filesystem>
#include <iostream>
#include <iterator>

#ifdef SDF_CCD_WITH_OCTOMAP
#include <octomap/OcTree.h>
#include <sstream>
#endif

#include "mesh/import/read_answer.h"
#include "oracle/file_versions.h"
#include "oracle/mesh_bytes.h"
#include "oracle/open_shapes.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"
#include "valid_file.h"

namespace sdf_ccd::fuzz {
namespace {

namespace fs = std::filesystem;

class Seeds {
 public:
  Seeds(fs::path folder, fs::path source) : folder_(std::move(folder)), source_(std::move(source)) {}

  void write() {
    writeMeshes();
    writeOctomap();
    writeFields();
    writeAnswers();
    writeTexts();
    writeHostile();
  }

 private:
  void add(const std::string& target, const std::string& name, const std::string& bytes) {
    fs::create_directories(folder_ / target);
    std::ofstream(folder_ / target / name, std::ios::binary) << bytes;
  }

  void copy(const std::string& target, const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    add(target, file.filename(), {std::istreambuf_iterator<char>(stream), {}});
  }

  void writeMeshes() {
    const TriangleMesh box = test::boxMesh({1, 2, 3});
    add("stl", "binary", test::binaryStl(box, "binary"));
    add("stl", "ascii", test::asciiStl(box));
    add("obj", "box", test::obj(box));
    add("obj", "relative", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf -4/1/1 -3//1 \\\n -2\nf 1 2 3 4\n");
    add("off", "box", test::off(box));
    add("off", "comments", "OFF # a\n4 1 0\n0 0 0\n1 0 0 # b\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n");
    add("ply", "ascii", test::ply(box));
    add("ply", "little", test::binaryPly(box, false));
    add("ply", "big", test::binaryPly(box, true));
    add("dae", "nodes",
        test::dae(box, "<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>",
                  std::string("<node id=\"n\"><translate>1 2 3</translate><rotate>0 0 1 90</rotate>"
                              "<scale>1 2 1</scale>") +
                      test::kDaeInstance + "</node><node><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>" +
                      "<instance_node url=\"#n\"/></node>"));
  }

  void writeOctomap() {
#ifdef SDF_CCD_WITH_OCTOMAP
    octomap::OcTree tree(0.1);
    for (int i = 0; i < 5; ++i) tree.updateNode(octomap::point3d(0.1F * float(i), 0.05F, 0.3F), i != 3);
    tree.updateInnerOccupancy();
    std::ostringstream full, binary;
    tree.write(full);
    tree.writeBinary(binary);
    add("octomap", "full", full.str());
    add("octomap", "binary", binary.str());
    // The message holds the file without its header, which ends with the line "data".
    const auto voxelMap = [&](const std::string& file, char kind) {
      const std::string data = "data\n";
      add("voxel_map", std::string(1, 'a' + kind),
          std::string{kind, 1, kind, 0} + file.substr(file.find(data) + data.size()));
    };
    voxelMap(binary.str(), 0);
    voxelMap(full.str(), 1);
#endif
  }

  void writeFields() {
    const InputFile file(".seed");
    const auto add_field = [&](const std::string& name, const TriangleMesh& mesh, const FieldOptions& options) {
      const bool is_adaptive = options.max_error > 0.0;
      saveField(buildField(mesh, options), file.path());
      add(is_adaptive ? "adaptive_field" : "field", name,
          inputOf(file.path(), is_adaptive ? "adaptive field" : "field", test::kFieldVersion));
    };
    FieldOptions even, adaptive;
    even.cells = 4;
    adaptive.max_error = 0.1;
    const TriangleMesh box = test::boxMesh({0.1, 0.2, 0.3}), bin = test::binMesh(0.3);
    add_field("box", box, even);
    add_field("bin", bin, even);
    add_field("box", box, adaptive);
    add_field("bin", bin, adaptive);
    ShellOptions shell;
    shell.spacing = 0.2;
    saveShell(sampleSurface(box, shell), file.path());
    add("shell", "box", inputOf(file.path(), "shell", test::kShellVersion));
  }

  void writeAnswers() {
    const auto bytes = [](const auto& value) {
      return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    };
    const TriangleMesh box = test::boxMesh({1, 2, 3});
    ReadAnswer answer;
    answer.vertices = box.vertices.size();
    answer.triangles = box.triangles.size();
    std::string mesh = bytes(answer);
    for (const Vector3d& v : box.vertices) mesh.append(reinterpret_cast<const char*>(v.data()), sizeof v);
    for (const Vector3i& t : box.triangles) mesh.append(reinterpret_cast<const char*>(t.data()), sizeof t);
    add("answer", "mesh", mesh);
    const std::string reason = "not a mesh";
    ReadAnswer refusal;
    refusal.reason_bytes = reason.size();
    add("answer", "reason", bytes(refusal) + reason);
  }

  void writeTexts() {
    for (const char* name : {"robot.urdf", "joints.urdf"}) copy("urdf", source_ / "fuzz/seeds" / name);
    copy("srdf", source_ / "fuzz/seeds/robot.srdf");
    copy("parameters", source_ / "fuzz/seeds/world.yaml");
    copy("parameters", source_ / "config/monitor.yaml");
    copy("simulation", source_ / "fuzz/seeds/boxes.yaml");
    copy("simulation", source_ / "config/scenes/stack.yaml");
    add("moveit_scene", "objects",
        "name\n* a\n0 0 0\n0 0 0 1\n2\nbox\n1 2 3\n0 0 0\n0 0 0 1\n0 0 0 0\nmesh\n3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 2\n0 0 "
        "2\n0 0 0 1\n0 0 "
        "0 0\n1\nsub\n0 0 0\n0 0 0 1\n.\n");
    add("moveit_scene", "before",
        "(noname)+\n* b\n2\nplane\n0 0 1 0\n0 0 0\n0 0 0 1\n1 0 0 1\ncone\n1 2\n0 0 0\n0 0 0 1\n1 0 0 1\n.\n");
    add("segments", "header", "ox,oy,oz,ex,ey,ez\n0,0,0,1,1,1\n-1e-3, 2.5,0,1,.5,0x1p3\r\n\n");
    for (const char* target : {"query_motion", "query_motions", "query_points", "transforms", "update_scene"}) {
      for (int k = 1; k < 32; ++k) {
        std::string numbers;
        for (int i = 0; i < 96; ++i) numbers += static_cast<char>(i % 3 == 0 ? k : 17 * i * k % 251);
        add(target, std::to_string(k), numbers);
      }
    }
  }

  /// Copies the inputs that once broke a reader to all targets of their kind, except the node bomb, which is slow to
  /// refuse.
  void writeHostile() {
    for (const auto& entry : fs::directory_iterator(source_ / "test/data/hostile")) {
      const std::string ending = entry.path().extension();
      if (ending == ".urdf") copy("urdf", entry.path());
      if (ending == ".bt" || ending == ".ot") copy("octomap", entry.path());
      if (ending == ".yaml") {
        copy("parameters", entry.path());
        copy("simulation", entry.path());
      }
      if (entry.path().stem() == "node_bomb") continue;
      for (const char* format : {"stl", "obj", "off", "ply", "dae"}) copy(format, entry.path());
    }
  }

  fs::path folder_, source_;
};

}  // namespace
}  // namespace sdf_ccd::fuzz

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: fuzz_seeds FOLDER SOURCE_FOLDER\n";
    return 2;
  }
  try {
    sdf_ccd::fuzz::Seeds(argv[1], argv[2]).write();
  } catch (const std::exception& error) {
    std::cerr << "fuzz_seeds: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
