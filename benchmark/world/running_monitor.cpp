#include "world/running_monitor.h"

namespace sdf_ccd::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

RunningMonitor::RunningMonitor(std::shared_ptr<const WorldSnapshot> world, Place place)
    : place_(std::move(place)), world_(std::move(world)), monitor_(world_->scene, {}), motion_(restingMotion(*world_)) {
  thread_ = std::thread([this] { run(); });
}

RunningMonitor::~RunningMonitor() {
  stop_ = true;
  thread_.join();
}

CycleMotion RunningMonitor::restingMotion(const WorldSnapshot& world) const {
  CycleMotion motion;
  motion.times = {0.0, 1e-3};
  for (const BodyDescription& body : world.description->bodies)
    motion.X_WB.push_back(std::vector<Isometry3d>(2, place_(body, time_)));
  return motion;
}

/// Sets the poses of moving bodies; world bodies, which come after them, keep their poses.
void RunningMonitor::setMotion(double from, double until) {
  const std::vector<BodyDescription>& bodies = world_->description->bodies;
  for (std::size_t b = 0; b < bodies.size() && !bodies[b].is_world; ++b)
    motion_.X_WB[b] = {place_(bodies[b], from), place_(bodies[b], until)};
}

void RunningMonitor::change(const std::shared_ptr<const WorldSnapshot>& world) {
  auto offer = std::make_unique<Offer>();
  offer->world = world;
  offer->motion = restingMotion(*world);
  offer->change = monitor_.prepare(world->scene, &offer->motion);
  is_checked_ = false;
  given_ = std::move(offer);
  offered_ = given_.get();
  while (!is_checked_) std::this_thread::sleep_for(std::chrono::microseconds(50));
  given_.reset();  // frees the previous world, which the cycle has swapped into the offer
}

std::vector<double> RunningMonitor::takeTimes() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::move(times_);
}

std::vector<double> RunningMonitor::takeAdoptions() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::move(adoptions_);
}

std::vector<double> RunningMonitor::takeFirstTimes() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::move(first_times_);
}

CycleVerdicts RunningMonitor::firstCycle() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return first_;
}

void RunningMonitor::run() {
  constexpr auto kPeriod = std::chrono::milliseconds(1);
  const CycleRequest request{false, 0, false, false};
  for (Clock::time_point next = Clock::now(); !stop_; next += kPeriod) {
    std::this_thread::sleep_until(next);
    next = std::max(next, Clock::now() - 10 * kPeriod);  // missed cycles are not caught up on
    const Clock::time_point start = Clock::now();
    Offer* const offer = offered_.exchange(nullptr);
    if (offer) {
      monitor_.adopt(*offer->change);
      world_.swap(offer->world);
      std::swap(motion_, offer->motion);
    }
    const Clock::time_point adopted = Clock::now();
    setMotion(time_, time_ + 1e-3);
    time_ = time_ + 1e-3;
    const Clock::time_point ready = Clock::now();
    const CycleResult& result = monitor_.run(motion_, request);
    const Clock::time_point end = Clock::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    times_.push_back(seconds(adopted - start) + seconds(end - ready));
    if (!offer) continue;
    adoptions_.push_back(seconds(adopted - start));
    first_times_.push_back(times_.back());
    first_ = {world_, motion_, {}};
    for (const PairResult& pair : result.pairs) first_.verdicts.push_back(pair.verdict);
    is_checked_ = true;
  }
}

}  // namespace sdf_ccd::benchmark
