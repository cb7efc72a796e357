#include "core/io/frame_columns.hpp"

#include <cstdint>

#include "core/forces/applied_forces.hpp"
#include "core/io/csv_text.hpp"
#include "core/io/json.hpp"
#include "core/sim/conserved.hpp"

namespace substep {
namespace {

std::string number(double x) { return csv_number(x); }
std::string number(std::int64_t x) { return std::to_string(x); }
std::string number(int x) { return std::to_string(x); }
std::string number(bool x) { return x ? "1" : "0"; }

/// A member of the report of a frame, or of its solver's work, or of what determined r.
template <auto kMember>
std::string report(const FrameView& f) {
  return number(f.report.*kMember);
}
template <auto kMember>
std::string work(const FrameView& f) {
  return number(f.report.work.*kMember);
}
template <auto kMember>
std::string leading(const FrameView& f) {
  return number(f.report.leader.*kMember);
}

/// Centre of the tracked body, along one axis [m].
template <int kAxis>
std::string tracked(const FrameView& f) {
  const int body = f.scene.criteria.track.value_or(-1);
  if (body < 0 || index(body) >= f.state.x.size()) return "nan";
  return number(f.state.x[index(body)][kAxis]);
}

/// Sum over bodies, along one world axis.
template <int kAxis>
std::string momentum(const FrameView& f) {
  return number(momenta_of(f.scene, f.state).linear[kAxis]);
}
template <int kAxis>
std::string angular_momentum(const FrameView& f) {
  return number(momenta_of(f.scene, f.state).angular[kAxis]);
}

std::string leader(const FrameView& f) {
  const int body = f.report.leader.body;
  return body < 0 || index(body) >= f.scene.bodies.size() ? "" : f.scene.bodies[index(body)].name;
}

constexpr FrameColumn kFrameColumns[] = {
    {"frame", "completed frames [-]", report<&FrameReport::frame>},
    {"time", "at the end of the frame [s]", report<&FrameReport::time>},
    {"substeps", "sub-steps N of this frame [-]", report<&FrameReport::n_substeps>},
    {"discarded", "sub-steps of attempts at this frame that were discarded [-]",
     report<&FrameReport::n_discarded>},
    {"substeps_mean", "mean of the sub-steps per body [-]", report<&FrameReport::n_mean>},
    {"islands", "number of islands; 0: not determined [-]", report<&FrameReport::islands>},
    {"asleep", "sleeping bodies, which no sub-step moves [-]", report<&FrameReport::asleep>},
    {"substeps_wanted", "N by Eq. 11, before the cap [-]", report<&FrameReport::n_wanted>},
    {"capped", "1 if the cap limited N [-]", report<&FrameReport::capped>},
    {"dt_min", "shortest sub-step [s]", report<&FrameReport::dt_min>},
    {"dt_max", "longest sub-step [s]", report<&FrameReport::dt_max>},
    {"dt_stable", "2 sqrt(alpha/r), Eq. 10 [s]", report<&FrameReport::dt_stable>},
    {"r", "largest k/M, Eq. 9 [1/s^2]", leading<&StiffnessLeader::r>},
    {"leader", "the body that determines r", leader, nullptr, false},
    {"leader_dof", "its degree of freedom: 0-2 along x, y, z, 3-5 about its principal axes [-]",
     leading<&StiffnessLeader::dof>},
    {"kinetic", "kinetic energy [J]", report<&FrameReport::kinetic>},
    {"potential", "potential energy of gravity and constant forces [J]",
     report<&FrameReport::potential>},
    {"elastic", "energy of compliant joints and contacts [J]", report<&FrameReport::elastic>},
    {"energy", "kinetic and potential energy, and that of springs [J]",
     report<&FrameReport::energy>},
    {"parting", "work of parting overlaps in the frame [J]", report<&FrameReport::parting>,
     &Effects::contact},
    {"lowered", "impacts whose restitution was lowered, because it would add energy [-]",
     report<&FrameReport::lowered>, &Effects::restitution},
    {"px", "momentum of all bodies [kg m/s]", momentum<0>},
    {"py", "momentum of all bodies [kg m/s]", momentum<1>},
    {"pz", "momentum of all bodies [kg m/s]", momentum<2>},
    {"lx", "angular momentum about the origin [kg m^2/s]", angular_momentum<0>},
    {"ly", "angular momentum about the origin [kg m^2/s]", angular_momentum<1>},
    {"lz", "angular momentum about the origin [kg m^2/s]", angular_momentum<2>},
    {"constraint_error", "sum of the errors of all joint rows, springs excepted [m, rad]",
     report<&FrameReport::constraint_error>, &Effects::joints},
    {"joint_gap", "largest gap of a joint that is no spring [m]", report<&FrameReport::joint_gap>,
     &Effects::joints},
    {"joint_rows", "rows of joints [-]", report<&FrameReport::joint_rows>, &Effects::joints},
    {"penetration", "deepest overlap [m]", report<&FrameReport::penetration>, &Effects::contact},
    {"contact_rows", "normal rows [-]", report<&FrameReport::contact_rows>, &Effects::contact},
    {"friction_rows", "friction rows [-]", report<&FrameReport::friction_rows>, &Effects::friction},
    {"iterations", "sweeps of PGS [-]", work<&SolverWork::iterations>},
    {"pivots", "changes of the active set of BPP [-]", work<&SolverWork::pivots>},
    {"unsolved", "solves of BPP given up [-]", work<&SolverWork::unsolved>},
    {"residual", "largest violation of bounds and complementarity [N s, m/s]",
     work<&SolverWork::residual>},
    {"x", "the tracked body's centre [m]", tracked<0>},
    {"y", "the tracked body's centre [m]", tracked<1>},
    {"z", "the tracked body's centre [m]", tracked<2>},
    {"ms", "computing time of the frame [ms]",
     [](const FrameView& f) { return number(1e3 * f.report.times.total); }},
};

bool is_tracked_position(const FrameColumn& c) {
  return c.name == "x" || c.name == "y" || c.name == "z";
}

}  // namespace

std::vector<FrameColumn> frame_columns(const Scene& scene) {
  std::vector<FrameColumn> columns;
  for (const FrameColumn& column : kFrameColumns) {
    if (column.effect && !(scene.effects.*column.effect)) continue;
    if (column.name == "potential" && !has_applied_forces(scene.effects)) continue;
    if (is_tracked_position(column) && !scene.criteria.track) continue;
    columns.push_back(column);
  }
  return columns;
}

std::string csv_header(const std::vector<FrameColumn>& columns) {
  std::string line;
  for (const FrameColumn& column : columns) {
    if (!line.empty()) line += ',';
    line += column.name;
  }
  return line + '\n';
}

std::string csv_line(const std::vector<FrameColumn>& columns, const FrameView& frame) {
  std::string line;
  const char* separator = "";
  for (const FrameColumn& column : columns) {
    line += separator;
    separator = ",";
    const std::string text = column.text(frame);
    line += column.is_number ? text : csv_field(text);
  }
  return line + '\n';
}

std::string json_line(const std::vector<FrameColumn>& columns, const FrameView& frame) {
  std::string line = "{";
  const char* separator = "";
  for (const FrameColumn& column : columns) {
    line += separator;
    separator = ", ";
    line += '"';
    line += column.name;
    line += "\": ";
    const std::string text = column.text(frame);
    if (!column.is_number) {
      line +=
          text.empty() ? "null" : Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    } else {
      const bool finite = text.find_first_of("in") == std::string::npos;  // "inf", "nan"
      line += finite ? text : "null";
    }
  }
  return line + '}';
}

}  // namespace substep
