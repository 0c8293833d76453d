#include "sdf_ccd/body.h"

namespace sdf_ccd {

const char* whyNoForces(Forces forces) {
  switch (forces) {
    case Forces::kKnown:
      return "";
    case Forces::kAwaited:
      return "its field and shell are being built";
    case Forces::kUnwanted:
      return "its field and shell are not wanted (parameter wrenches)";
    case Forces::kFailed:
      return "its field and shell could not be built";
  }
  return "";
}

}  // namespace sdf_ccd
