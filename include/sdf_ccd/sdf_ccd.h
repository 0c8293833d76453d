#pragma once

/// Everything needed to check moving bodies. Robots have a header of their own: sdf_ccd/robot_scene.h.
#include "sdf_ccd/body.h"
#include "sdf_ccd/cancel.h"
#include "sdf_ccd/distances.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/monitor.h"
#include "sdf_ccd/scene.h"
#include "sdf_ccd/segments.h"
