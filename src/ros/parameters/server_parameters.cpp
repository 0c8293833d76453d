#include "ros/parameters/server_parameters.h"

namespace sdf_ccd {

Setting toSetting(XmlRpc::XmlRpcValue value) {
  using XmlRpc::XmlRpcValue;
  Setting::List list;
  Setting::Group group;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return {static_cast<bool>(value)};
    case XmlRpcValue::TypeInt:
      return {static_cast<int>(value)};
    case XmlRpcValue::TypeDouble:
      return {static_cast<double>(value)};
    case XmlRpcValue::TypeString:
      return {static_cast<std::string>(value)};
    case XmlRpcValue::TypeArray:
      for (int i = 0; i < value.size(); ++i) list.push_back(toSetting(value[i]));
      return {list};
    case XmlRpcValue::TypeStruct:
      for (auto& member : value) group.emplace(member.first, toSetting(member.second));
      return {group};
    default:
      return value.valid() ? Setting{value.toXml()} : Setting();  // dates and bytes, which no parameter takes
  }
}

}  // namespace sdf_ccd
