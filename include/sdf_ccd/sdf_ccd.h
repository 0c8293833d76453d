#pragma once

/// All that checking bodies in motion takes. Robots are apart: sdf_ccd/robot/robot_scene.h and what lies beside it.
#include "sdf_ccd/body/prepare_body.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/import/mesh_file.h"
#include "sdf_ccd/monitor/monitor.h"
#include "sdf_ccd/monitor/world.h"
#include "sdf_ccd/query/segment_batch.h"
#include "sdf_ccd/query/segment_query.h"
