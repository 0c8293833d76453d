#include "collada_mesh.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "polygon_mesh.h"
#include "xml_numbers.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

const XMLElement* childById(const XMLElement& parent, const char* name, const std::string& id) {
  for (const XMLElement* child = parent.FirstChildElement(name); child; child = child->NextSiblingElement(name)) {
    if (attributeOf(*child, "id") == id) return child;
  }
  throw std::runtime_error("no <" + std::string(name) + "> of the id \"" + id + "\" in " + describe(parent));
}

const XMLElement* inputOf(const XMLElement& parent, const char* semantic) {
  for (const XMLElement* input = parent.FirstChildElement("input"); input; input = input->NextSiblingElement("input")) {
    if (attributeOf(*input, "semantic") == semantic) return input;
  }
  return nullptr;
}

/// Indices of an accessor's parameters X, Y and Z; 0, 1 and 2 if they are not named. Sets `parameters` to their count.
std::array<std::size_t, 3> coordinatesOf(const XMLElement& accessor, std::size_t& parameters) {
  std::array<std::size_t, 3> offsets = {0, 1, 2};
  parameters = 0;
  for (const XMLElement* p = accessor.FirstChildElement("param"); p; p = p->NextSiblingElement("param")) {
    const std::string name = attributeOf(*p, "name");
    if (name.size() == 1 && name[0] >= 'X' && name[0] <= 'Z') offsets[name[0] - 'X'] = parameters;
    ++parameters;
  }
  return offsets;
}

std::vector<Vector3d> positionsOf(const XMLElement& source) {
  const XMLElement* technique = source.FirstChildElement("technique_common");
  const XMLElement* accessor = technique ? technique->FirstChildElement("accessor") : nullptr;
  if (!accessor) throw std::runtime_error(describe(source) + " has no accessor");
  const XMLElement& array = *childById(source, "float_array", referenceOf(*accessor, "source"));
  const std::vector<double> numbers = numbersOf(array);
  const std::uint64_t length = std::min<std::uint64_t>(numbers.size(), countOf(array, "count", numbers.size()));
  const std::uint64_t stride = countOf(*accessor, "stride", 1), count = countOf(*accessor, "count", 0);
  const std::uint64_t offset = countOf(*accessor, "offset", 0);
  std::size_t parameters = 0;
  const std::array<std::size_t, 3> offsets = coordinatesOf(*accessor, parameters);
  const bool is_whole = parameters <= stride && stride > *std::max_element(offsets.begin(), offsets.end());
  // Divides instead of multiplying: the product of two numbers of an untrusted file may overflow.
  if (!is_whole || offset > length || (count > 0 && (length - offset) / count < stride)) {
    throw std::runtime_error(describe(*accessor) + " reads beyond the " + std::to_string(length) + " numbers of \"#" +
                             attributeOf(array, "id") + "\"");
  }
  std::vector<Vector3d> positions;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double* p = numbers.data() + offset + i * stride;
    positions.emplace_back(p[offsets[0]], p[offsets[1]], p[offsets[2]]);
  }
  return positions;
}

/// Adds the polygons of one `<triangles>`, `<polylist>`, … to a PolygonList.
class PrimitiveReader {
 public:
  PrimitiveReader(const XMLElement& element, PolygonList& polygons) : element_(element), polygons_(polygons) {
    for (const XMLElement* input = element.FirstChildElement("input"); input;
         input = input->NextSiblingElement("input")) {
      stride_ = std::max(stride_, countOf(*input, "offset", 0) + 1);
    }
    const XMLElement* vertex = inputOf(element, "VERTEX");
    if (!vertex) throw std::runtime_error(describe(element) + " has no input of semantic VERTEX");
    offset_ = countOf(*vertex, "offset", 0);
  }

  void read() {
    const std::string kind = element_.Name();
    if (element_.FirstChildElement("ph")) throw std::runtime_error("polygons with holes (<ph>) are not supported");
    std::uint64_t found = 0;
    for (const XMLElement* p = element_.FirstChildElement("p"); p; p = p->NextSiblingElement("p")) {
      const std::vector<std::int64_t> corners = cornersOf(*p);
      if (kind == "triangles") found += addTriangles(corners);
      if (kind == "polylist") found += addPolygons(corners);
      if (kind == "polygons") polygons_.add(corners);
      if (kind == "trifans") addFan(corners);
      if (kind == "tristrips") addStrip(corners);
      if (kind != "triangles" && kind != "polylist") ++found;
    }
    const std::uint64_t announced = countOf(element_, "count", found);
    if (announced != found) {
      throw std::runtime_error(describe(element_) + " announces " + std::to_string(announced) + ", there are " +
                               std::to_string(found));
    }
  }

 private:
  /// The vertex indices of one `<p>`, without the interleaved indices of normals, colours and textures.
  std::vector<std::int64_t> cornersOf(const XMLElement& p) const {
    const std::vector<std::int64_t> indices = indicesOf(p);
    if (indices.size() % stride_ != 0) throw std::runtime_error(describe(p) + " ends within a corner");
    std::vector<std::int64_t> corners;
    for (std::size_t i = offset_; i < indices.size(); i += stride_) corners.push_back(indices[i]);
    return corners;
  }

  std::uint64_t addTriangles(const std::vector<std::int64_t>& corners) {
    if (corners.size() % 3 != 0) throw std::runtime_error(describe(element_) + " ends within a triangle");
    for (std::size_t i = 0; i < corners.size(); i += 3) polygons_.add({corners[i], corners[i + 1], corners[i + 2]});
    return corners.size() / 3;
  }

  std::uint64_t addPolygons(const std::vector<std::int64_t>& corners) {
    const XMLElement* counts = element_.FirstChildElement("vcount");
    const std::vector<std::int64_t> sizes = counts ? indicesOf(*counts) : std::vector<std::int64_t>();
    std::size_t begin = 0;
    for (const std::int64_t size : sizes) {
      if (size < 0 || static_cast<std::uint64_t>(size) > corners.size() - begin) {
        throw std::runtime_error(describe(element_) + " has fewer corners than its <vcount> says");
      }
      const auto first = corners.begin() + static_cast<std::ptrdiff_t>(begin);
      polygons_.add({first, first + size});
      begin += static_cast<std::size_t>(size);
    }
    if (begin != corners.size()) {
      throw std::runtime_error(describe(element_) + " has more corners than its <vcount> says");
    }
    return sizes.size();
  }

  void addFan(const std::vector<std::int64_t>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) polygons_.add({corners[0], corners[i - 1], corners[i]});
  }

  void addStrip(const std::vector<std::int64_t>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const bool odd = i % 2 != 0;
      polygons_.add({corners[odd ? i - 1 : i - 2], corners[odd ? i - 2 : i - 1], corners[i]});
    }
  }

  const XMLElement& element_;
  PolygonList& polygons_;
  std::uint64_t stride_ = 1, offset_ = 0;
};

}  // namespace

TriangleMesh colladaMesh(const XMLElement& mesh) {
  TriangleMesh result;
  PolygonList polygons;
  for (const char* kind : {"triangles", "polylist", "polygons", "trifans", "tristrips"}) {
    for (const XMLElement* element = mesh.FirstChildElement(kind); element;
         element = element->NextSiblingElement(kind)) {
      PrimitiveReader(*element, polygons).read();
    }
  }
  const XMLElement* vertices = mesh.FirstChildElement("vertices");
  const XMLElement* positions = vertices ? inputOf(*vertices, "POSITION") : nullptr;
  if (!positions) return result;
  result.vertices = positionsOf(*childById(mesh, "source", referenceOf(*positions, "source")));
  polygons.appendTo(result);
  return result;
}

}  // namespace sdf_ccd
