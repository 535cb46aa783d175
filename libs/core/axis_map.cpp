#include "core/axis_map.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <sstream>

namespace vpdr {
namespace {

/// Row of the map for one name, "+x" or "x" or "-z"; zero where it is no axis.
Eigen::RowVector3d row_of(const std::string& name) {
  const bool has_sign = !name.empty() && (name[0] == '+' || name[0] == '-');
  const std::string letter = has_sign ? name.substr(1) : name;
  const double sign = has_sign && name[0] == '-' ? -1.0 : 1.0;
  Eigen::RowVector3d row = Eigen::RowVector3d::Zero();
  if (letter == "x") row.x() = sign;
  if (letter == "y") row.y() = sign;
  if (letter == "z") row.z() = sign;
  return row;
}

}  // namespace

Result<Eigen::Matrix3d> parse_axis_map(const std::string& names, bool allow_mirror) {
  const std::string example = "; write three different axes, as in +y,-x,+z";
  Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
  std::istringstream in(names);
  int row = 0;
  for (std::string name; std::getline(in, name, ',');) {
    if (row == 3) return Error{"\"" + names + "\" names more than three axes" + example};
    map.row(row) = row_of(name);
    if (map.row(row).isZero()) return Error{"\"" + name + "\" is no axis" + example};
    ++row;
  }
  const double determinant = map.determinant();
  if (row != 3 || determinant == 0.0) {
    return Error{"\"" + names + "\" does not name three different axes" + example};
  }
  if (determinant < 0.0 && !allow_mirror) {
    return Error{"\"" + names +
                 "\" is left-handed: no way of wearing the board gives that; flip one "
                 "sign or swap two axes"};
  }
  return map;
}

Eigen::Matrix3d nearest_axis_map(const Eigen::Matrix3d& matrix) {
  static constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  double best = -1.0;
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  for (const auto& order : kOrders) {
    double sum = 0.0;
    for (int row = 0; row < 3; ++row)
      sum += std::abs(matrix(row, order[static_cast<std::size_t>(row)]));
    if (sum <= best) continue;
    best = sum;
    map.setZero();
    for (int row = 0; row < 3; ++row) {
      const int column = order[static_cast<std::size_t>(row)];
      map(row, column) = matrix(row, column) < 0.0 ? -1.0 : 1.0;
    }
  }
  return map;
}

std::string axis_map_name(const Eigen::Matrix3d& map) {
  std::string name;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      if (map(row, column) == 0.0) continue;
      if (!name.empty()) name += ',';
      name += map(row, column) < 0.0 ? '-' : '+';
      name += "xyz"[column];
    }
  }
  return name;
}

}  // namespace vpdr
