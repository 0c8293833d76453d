#pragma once

#include <memory>

namespace sdf_ccd {

struct MonitorMemory;

/// Scratch memory for monitors that are to share it.
std::shared_ptr<MonitorMemory> makeMonitorMemory();

}  // namespace sdf_ccd
