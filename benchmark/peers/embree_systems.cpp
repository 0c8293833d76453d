#include <algorithm>

#include "embree_scene.h"
#include "segment_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// Start of the next ray, just behind a hit: all crossings are found by casting rays until none hits.
float behind(float t) {
  return t + 1e-6F;
}

class Embree1 : public SegmentSystem {
 public:
  explicit Embree1(std::shared_ptr<const EmbreeScene> scene) : scene_(std::move(scene)) {}

  std::string name() const override { return "embree"; }
  std::size_t bytes() const override { return scene_->bytes(); }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    long answers = 0;
    for (std::size_t i = 0; i < count; ++i) {
      RTCRayHit ray = EmbreeScene::ray(segments[i]);
      if (question.find == Find::kAny) {
        rtcOccluded1(scene_->get(), &context, &ray.ray);
        answers += ray.ray.tfar < 0.0F;
        continue;
      }
      rtcIntersect1(scene_->get(), &context, &ray);
      while (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        ++answers;
        if (question.find == Find::kFirst) break;
        ray.ray.tnear = behind(ray.ray.tfar);
        if (ray.ray.tnear >= 1.0F) break;
        ray.ray.tfar = 1.0F;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_->get(), &context, &ray);
      }
    }
    return answers;
  }

  bool tellsTimes() const override { return true; }
  void firstTimes(const std::vector<Segment>& segments, std::vector<double>& times) override {
    times.resize(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) times[i] = scene_->firstHit(segments[i]);
  }

 private:
  std::shared_ptr<const EmbreeScene> scene_;
};

class Embree16 : public SegmentSystem {
 public:
  explicit Embree16(std::shared_ptr<const EmbreeScene> scene) : scene_(std::move(scene)) {}

  std::string name() const override { return "embree16"; }
  std::size_t bytes() const override { return scene_->bytes(); }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    long answers = 0;
    for (std::size_t i = 0; i < count; i += 16) {
      answers += packet(segments + i, std::min<std::size_t>(16, count - i), question.find);
    }
    return answers;
  }

 private:
  long packet(const Segment* segments, std::size_t count, Find find) {
    alignas(64) RTCRayHit16 rays;
    alignas(64) int valid[16] = {};
    for (std::size_t k = 0; k < count; ++k) {
      const Segment& s = segments[k];
      const Vector3d d = s.end - s.start;
      rays.ray.org_x[k] = float(s.start.x());
      rays.ray.org_y[k] = float(s.start.y());
      rays.ray.org_z[k] = float(s.start.z());
      rays.ray.dir_x[k] = float(d.x());
      rays.ray.dir_y[k] = float(d.y());
      rays.ray.dir_z[k] = float(d.z());
      rays.ray.tnear[k] = 0.0F;
      rays.ray.tfar[k] = 1.0F;
      rays.ray.time[k] = 0.0F;
      rays.ray.mask[k] = ~0U;
      rays.ray.flags[k] = 0;
      rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      valid[k] = -1;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    long answers = 0;
    if (find == Find::kAny) {
      rtcOccluded16(valid, scene_->get(), &context, &rays.ray);
      for (std::size_t k = 0; k < count; ++k) answers += rays.ray.tfar[k] < 0.0F;
      return answers;
    }
    for (bool open = true; open;) {
      open = false;
      rtcIntersect16(valid, scene_->get(), &context, &rays);
      for (std::size_t k = 0; k < count; ++k) {
        if (valid[k] == 0) continue;
        valid[k] = 0;
        if (rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
        ++answers;
        rays.ray.tnear[k] = behind(rays.ray.tfar[k]);
        if (find == Find::kFirst || rays.ray.tnear[k] >= 1.0F) continue;
        rays.ray.tfar[k] = 1.0F;
        rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        valid[k] = -1;
        open = true;
      }
    }
    return answers;
  }

  std::shared_ptr<const EmbreeScene> scene_;
};

const Registered kEmbree{MeshFactory([](const TriangleMesh& mesh, SegmentSystems& systems) {
  auto scene = std::make_shared<const EmbreeScene>(mesh);
  systems.push_back(std::make_unique<Embree1>(scene));
  systems.push_back(std::make_unique<Embree16>(scene));
})};

}  // namespace
}  // namespace sdf_ccd::benchmark
