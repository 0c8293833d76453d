#pragma once

#include <XmlRpcValue.h>

#include "common/settings/setting.h"

namespace sdf_ccd {

/// A parameter of the parameter server; an empty group if it is not set.
Setting toSetting(XmlRpc::XmlRpcValue value);

}  // namespace sdf_ccd
