#include "core/io/carried_json.hpp"

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "core/model/format_text.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

constexpr std::string_view kSides = "-0+?";  // of StoredForce::active_set from -1 on; ?: not known
constexpr std::size_t kStoredRows = kMaxRows;

/// One item per body, with the numbers of an Item; matrices by columns.
template <class Item>
void read_items(ObjectReader& in, std::string_view key, const Range& range, std::size_t bodies,
                std::vector<Item>& items) {
  std::vector<Item> read(bodies, Item::Zero());
  const auto size = static_cast<std::size_t>(Item::SizeAtCompileTime);
  static_assert(sizeof(Item) == Item::SizeAtCompileTime * sizeof(double));
  double* first = bodies > 0 ? read.front().data() : nullptr;
  if (in.table(key, range, first, bodies, size, kOptional)) items = std::move(read);
}

template <class Item>
Json items_json(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items)
    list.push_back(std::vector(item.data(), item.data() + item.size()));
  return list;
}

/// The names of two lists that belong together: an item of each per body.
struct PairNames {
  const char* first;
  const char* second;
};
constexpr PairNames kOwn{"own_dt_previous", "own_r"};
constexpr PairNames kRotation{"rotation_before", "rotation_now"};
constexpr PairNames kHeld{"held_before", "held_now"};

template <class Item>
void read_pairs(ObjectReader& in, const PairNames& names, const Range& first_range,
                std::size_t bodies, std::vector<Item>& items) {
  std::vector<double> first(bodies);
  std::vector<double> second(bodies);
  const bool has_first = in.numbers(names.first, first_range, first.data(), bodies, kOptional);
  const bool has_second =
      in.numbers(names.second, kStiffnessOverMassRange, second.data(), bodies, kOptional);
  if ((in.member(names.first, kOptional) == nullptr) !=
      (in.member(names.second, kOptional) == nullptr)) {
    in.problem(names.second,
               std::string(names.second) + " and " + names.first + " must be given together");
  }
  if (!has_first || !has_second) return;
  for (std::size_t i = 0; i < bodies; ++i) items.push_back({first[i], second[i]});
}

template <class Item>
void write_pairs(const PairNames& names, const std::vector<Item>& items, Json& json) {
  Json first = Json::array();
  Json second = Json::array();
  for (const auto& [a, b] : items) {
    first.push_back(a);
    second.push_back(b);
  }
  json[names.first] = std::move(first);
  json[names.second] = std::move(second);
}

StoredForce read_force(const Json& json, const std::string& pointer, Problems& problems) {
  ObjectReader in(json, pointer, problems);
  StoredForce force;
  if (!in.is_object()) return force;
  std::string id;
  if (in.text("id", kMaxNameSize, id, kRequired)) {
    const char* end = id.data() + id.size();
    const auto [read, error] = std::from_chars(id.data(), end, force.id, 16);
    if (read != end || error != std::errc{}) {
      in.problem("id", must_be("a hexadecimal number of at most 16 digits", value_text(id)));
    }
  }
  const auto rows = [&](std::string_view key, const Range& range, double* numbers,
                        Presence presence) {
    const Json* list = in.member(key, presence);
    if (!list) return;
    if (!list->is_array() || list->size() > kStoredRows) {
      in.problem(key, must_be("a list of at most " + std::to_string(kStoredRows) + " numbers",
                              value_text(*list)));
    } else {
      in.numbers(key, range, numbers, list->size(), presence);
    }
  };
  rows("lambda", kForceRange, force.lambda, kRequired);
  rows("rate", kForceRateRange, force.rate, kOptional);
  rows("rate_change", kForceRateChangeRange, force.rate_change, kOptional);
  in.number("rate_age", not_negative(1.0, "s"), force.rate_age, kOptional);
  rows("elastic", kElasticRange, force.elastic, kOptional);
  std::string tight;
  if (in.text("tight", kStoredRows, tight, kOptional)) {
    for (std::size_t row = 0; row < tight.size(); ++row) {
      const std::size_t side = kSides.find(tight[row]);
      if (side == std::string_view::npos) {
        in.problem("tight", must_be("made of -, 0, + and ?", value_text(tight)));
        break;
      }
      force.active_set[row] = static_cast<std::int8_t>(static_cast<int>(side) - 1);
    }
  }
  in.finish();
  return force;
}

Json force_json(const StoredForce& force) {
  const auto rows = [](const double(&numbers)[kStoredRows]) {
    std::size_t count = kStoredRows;
    while (count > 0 && numbers[count - 1] == 0.0) --count;
    return std::vector(numbers, numbers + count);
  };
  std::string tight;
  for (const std::int8_t side : force.active_set) {
    const int at = std::clamp(side + 1, 0, static_cast<int>(kSides.size()) - 1);
    tight += kSides[static_cast<std::size_t>(at)];
  }
  tight.erase(tight.find_last_not_of('0') + 1);
  Json json;
  json["id"] = format_text("%" PRIx64, force.id);
  json["lambda"] = rows(force.lambda);
  if (const auto rate = rows(force.rate); !rate.empty()) json["rate"] = rate;
  if (const auto change = rows(force.rate_change); !change.empty()) json["rate_change"] = change;
  if (force.rate_age != 0.0) json["rate_age"] = force.rate_age;
  if (const auto elastic = rows(force.elastic); !elastic.empty()) json["elastic"] = elastic;
  if (!tight.empty()) json["tight"] = tight;
  return json;
}

}  // namespace

std::optional<Carried> read_carried(ObjectReader& scene, const std::vector<Body>& bodies,
                                    Problems& problems) {
  const Json* json = scene.member("carried", kOptional);
  if (!json) return std::nullopt;
  const std::string pointer = scene.pointer("carried");
  ObjectReader in(*json, pointer, problems);
  Carried carried;
  if (!in.is_object()) return std::nullopt;
  const std::size_t n = bodies.size();
  in.number("dt_previous", not_negative(1.0, "s"), carried.dt_previous, kRequired);
  read_items(in, "u", kVelocityRange, n, carried.u);
  carried.stiffness_known = in.number("r", kStiffnessOverMassRange, carried.r, kOptional);
  read_items(in, "acceleration", kAccelerationRange, n, carried.acceleration);
  read_items(in, "acceleration_change", kAccelerationRange, n, carried.acceleration_change);
  read_items(in, "torque", kForceRange, n, carried.torque);
  read_items(in, "torque_change", kForceRange, n, carried.torque_change);
  read_items(in, "k", kStiffnessRange, n, carried.k);
  read_items(in, "k_resisting", kStiffnessRange, n, carried.K_resisting);
  read_pairs(in, kOwn, not_negative(1.0, "s"), n, carried.own);
  read_pairs(in, kRotation, kStiffnessOverMassRange, n, carried.rotation);
  in.number("rotation_age", not_negative(10.0, "s"), carried.rotation_age, kOptional);
  read_pairs(in, kHeld, kStiffnessOverMassRange, n, carried.held);
  in.integer("held_frames", 0, 10000, carried.held_frames, kOptional);
  for (const char* key : {"k", "k_resisting"}) {
    if (in.member(key, kOptional) && !in.member("r", kOptional)) in.problem(key, "requires r");
  }
  if (in.member("k_resisting", kOptional) && !in.member("k", kOptional)) {
    in.problem("k_resisting", "requires k");
  }
  std::vector<double> rest(n);
  if (in.numbers("rest", not_negative(1.0, "s"), rest.data(), n, kOptional)) carried.rest = rest;
  if (const Json* forces = in.member("forces", kOptional)) {
    if (!forces->is_array() || forces->size() > kMaxForces) {
      in.problem("forces", must_be("a list of at most " + std::to_string(kMaxForces) + " items",
                                   value_text(*forces)));
    } else {
      for (std::size_t i = 0; i < forces->size() && problems.size() <= kMaxProblems; ++i) {
        carried.forces.push_back(
            read_force((*forces)[i], pointer_to(in.pointer("forces"), i), problems));
      }
    }
  }
  in.finish();
  if (carried.u.empty()) {
    for (const Body& body : bodies) carried.u.push_back(velocity_of(body));
  }
  return carried;
}

Json carried_json(const Carried& carried, const std::vector<Body>& bodies) {
  Json json;
  json["dt_previous"] = carried.dt_previous;
  const bool own =
      std::equal(bodies.begin(), bodies.end(), carried.u.begin(), carried.u.end(),
                 [](const Body& body, const Vec6& u) { return velocity_of(body) == u; });
  if (!own) json["u"] = items_json(carried.u);
  if (carried.stiffness_known) {
    json["r"] = carried.r;
    if (!carried.k.empty()) json["k"] = items_json(carried.k);
    if (!carried.K_resisting.empty()) json["k_resisting"] = items_json(carried.K_resisting);
  }
  if (!carried.own.empty()) write_pairs(kOwn, carried.own, json);
  if (!carried.rotation.empty()) {
    write_pairs(kRotation, carried.rotation, json);
    json["rotation_age"] = carried.rotation_age;
  }
  if (!carried.held.empty()) {
    write_pairs(kHeld, carried.held, json);
    json["held_frames"] = carried.held_frames;
  }
  if (!carried.acceleration.empty()) json["acceleration"] = items_json(carried.acceleration);
  if (!carried.acceleration_change.empty()) {
    json["acceleration_change"] = items_json(carried.acceleration_change);
  }
  if (!carried.torque.empty()) json["torque"] = items_json(carried.torque);
  if (!carried.torque_change.empty()) json["torque_change"] = items_json(carried.torque_change);
  if (!carried.rest.empty()) json["rest"] = carried.rest;
  if (!carried.forces.empty()) {
    Json& forces = json["forces"] = Json::array();
    for (const StoredForce& force : carried.forces) forces.push_back(force_json(force));
  }
  return json;
}

}  // namespace substep
