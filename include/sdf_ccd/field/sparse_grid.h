#pragma once
#include <memory>
namespace sdf_ccd { class SparseGrid; }
