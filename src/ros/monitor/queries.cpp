#include "ros/monitor/queries.h"

#include <malloc.h>

#include <utility>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "common/refuse.h"
#include "common/seconds_since.h"
#include "ros/monitor/low_priority.h"
#include "ros/monitor/query_piece.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

constexpr double kLong = 0.05;        // after answers that take longer, freed memory is returned [s]
constexpr int kKeptByHeap = 1 << 20;  // at the end of each thread's heap: 64 MB by themselves [bytes]

}  // namespace

Queries::Queries(std::shared_ptr<const CheckedWorld> world, const DescribedScene& described,
                 const MonitorParameters& parameters, const TfHistory& history, const QueryLimits& limits)
    : world_(std::move(world)),
      robot_(described.robot),
      tf_prefix_(described.tf_prefix),
      base_joint_(described.base_joint),
      sampling_(parameters.tf.sampling),
      options_(parameters.monitor),
      max_points_(parameters.max_points),
      max_age_(parameters.tf.max_latency),
      history_(history),
      limits_(limits),
      request_time_(parameters.request_time),
      turns_(limits.queries, "queries are being answered") {
  mallopt(M_TRIM_THRESHOLD, kKeptByHeap);
}

void Queries::setWorld(std::shared_ptr<const CheckedWorld> world) {
  const std::lock_guard<std::mutex> lock(world_mutex_);
  world_.swap(world);
}

std::shared_ptr<const CheckedWorld> Queries::world() const {
  const std::lock_guard<std::mutex> lock(world_mutex_);
  return world_;
}

/// Refuses an outdated map: nothing is known of what is around the robot.
std::shared_ptr<const CheckedWorld> Queries::currentWorld(std::uint64_t& version) const {
  std::shared_ptr<const CheckedWorld> now = world();
  version = now->version();
  if (now->map_age && now->map_age->isTooOld(sinceEpoch(ros::Time::now()))) refuse(now->map_age->text());
  return now;
}

/// Answers with `make`, or with the reason why there is no answer.
template <class Request, class Response>
void Queries::answerWith(Make<Request, Response> make, const Request& request, Response& response) {
  lowerPriority();
  const auto start = std::chrono::steady_clock::now();
  const CancelPoint caller;
  QueryWork work;
  std::string why_not;
  try {
    const CancelScope scope(start + durationOf(request_time_));
    const WorkTurns::Caller registered(turns_);
    (this->*make)(request, response, work);
  } catch (const Cancelled&) {
    if (caller.requested()) throw;
    const std::string by = work.used_by.empty() ? "" : ", most of it for " + work.used_by;
    why_not =
        secondsSince(start) >= request_time_
            ? "the request has taken longer than " + numberText(request_time_) + " s (parameter request_time)" + by
            : "the request takes more than " + numberText(limits_.seconds) + " s" + by +
                  ": split it into parts, or send it again when the computer is less busy";
  } catch (const std::exception& error) {
    why_not = error.what();
  }
  if (!why_not.empty()) {
    const std::uint64_t version = response.scene_version;
    response = {};
    response.scene_version = version;
    response.message = why_not;
  }
  response.success = static_cast<std::uint8_t>(why_not.empty());
  if (secondsSince(start) > kLong) malloc_trim(0);
}

void Queries::answer(const QueryMotion::Request& request, QueryMotion::Response& response) {
  answerWith(&Queries::checkMotion, request, response);
}

void Queries::answer(const QueryMotions::Request& request, QueryMotions::Response& response) {
  answerWith(&Queries::checkMotions, request, response);
}

void Queries::answer(const QueryPoints::Request& request, QueryPoints::Response& response) {
  answerWith(&Queries::findDistances, request, response);
}

}  // namespace sdf_ccd
