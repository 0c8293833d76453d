#pragma once

/// Everything needed to check moving bodies. Robots have a header of their own: sdf_ccd/robot_scene.h.
#include "sdf_ccd/common/cancel.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/mesh/mesh_file.h"
#include "sdf_ccd/monitor/contact_tracker.h"
#include "sdf_ccd/monitor/monitor.h"
#include "sdf_ccd/monitor/nearest_body.h"
#include "sdf_ccd/monitor/pair_distances.h"
#include "sdf_ccd/monitor/velocity_scale.h"
#include "sdf_ccd/monitor/world.h"
#include "sdf_ccd/query/segment_query.h"
#include "sdf_ccd/scene/prepare_body.h"
