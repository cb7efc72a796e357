#include "core/lab/forecast.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/lab/experiment.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/validate.hpp"
#include "core/sim/simulator.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {
namespace {

using BodyPair = std::pair<int, int>;  // of bodies, the smaller first; 0 is the world, i + 1 body i

/// Graph of bodies and joints. All static bodies are one node, the world.
class JointGraph {
 public:
  explicit JointGraph(const Scene& scene)
      : scene_(scene), edges_(scene.bodies.size() + 1), seen_(edges_.size(), 0) {
    for (const Joint& joint : scene.joints) {
      const BodyPair pair = pair_of(joint);
      if (pair.first != pair.second && joints_[pair]++ == 0) {
        edges_[index(pair.first)].push_back(pair.second);
        edges_[index(pair.second)].push_back(pair.first);
      }
    }
    hang();
  }

  /// The mass carried by one joint [kg].
  [[nodiscard]] double load(const Joint& joint) const {
    const BodyPair pair = pair_of(joint);
    const auto found = load_.find(pair);
    return found == load_.end() ? 0.0 : found->second / joints_.at(pair);
  }

 private:
  struct Visit {
    int node;
    int parent;
    std::size_t next = 0;  // edge to look at
    int order = 0;         // when it was found
    int low = 0;  // low-link: the earliest node reachable from it and its subtree by other edges
    double mass = 0.0;  // including its subtree [kg]
  };

  [[nodiscard]] int node(int body) const { return is_fixed(scene_, body) ? 0 : body + 1; }
  [[nodiscard]] BodyPair pair_of(const Joint& joint) const {
    return std::minmax({node(base(joint).a), node(base(joint).b)});
  }

  /// Tarjan's search for bridges of the graph, starting at the world: a bridge carries everything
  /// below it. Iterative, because a rope may have thousands of links.
  void hang() {
    std::vector<Visit> path;
    std::vector<BodyPair> in_loops;
    int count = 0;
    double loose = 0.0;  // mass joined to the world [kg]
    const auto enter = [&](int n, int parent) {
      seen_[static_cast<std::size_t>(n)] = ++count;
      const double mass = n == 0 ? 0.0 : scene_.bodies[static_cast<std::size_t>(n - 1)].mass;
      loose += mass;
      path.push_back({n, parent, 0, count, count, mass});
    };
    enter(0, -1);
    while (!path.empty()) {
      Visit& here = path.back();
      const auto& edges = edges_[index(here.node)];
      if (here.next < edges.size()) {
        const int other = edges[here.next++];
        if (other == here.parent) continue;
        if (const int order = seen_[index(other)]) {
          here.low = std::min(here.low, order);
          in_loops.push_back(std::minmax(here.node, other));
        } else {
          enter(other, here.node);
        }
        continue;
      }
      const Visit done = here;
      path.pop_back();
      if (path.empty()) break;
      Visit& parent = path.back();
      parent.low = std::min(parent.low, done.low);
      parent.mass += done.mass;
      const BodyPair pair = std::minmax(done.node, parent.node);
      if (done.low > parent.order) {
        load_[pair] = done.mass;
      } else {
        in_loops.push_back(pair);
      }
    }
    for (const BodyPair& pair : in_loops) load_[pair] = 0.5 * loose;
  }

  const Scene& scene_;
  std::vector<std::vector<int>> edges_;
  std::vector<int> seen_;  // order of the search, 0: not yet
  std::map<BodyPair, int> joints_;
  std::map<BodyPair, double> load_;  // mass that a pair carries [kg]
};

/// Largest k/I with every joint under its load, and its body.
std::pair<double, int> hanging_bound(const Scene& scene) {
  const JointGraph graph(scene);
  const double g = scene.effects.gravity ? scene.gravity.norm() : 0.0;
  std::vector<Vec3> k(scene.bodies.size(), Vec3::Zero());  // about the principal axes [N m/rad]
  std::pair<double, int> most{0.0, -1};
  const auto add = [&](int body, const Vec3& arm, double force) {
    if (body == kWorld) return;
    for (int e = 0; e < 3; ++e) {
      k[index(body)][e] += force * arm.cross(Vec3::Unit(e)).norm();
    }
  };
  for (const Joint& joint : scene.joints) {
    const JointBase& j = base(joint);
    const double force = graph.load(joint) * g;
    add(j.a, j.anchor_a, force);
    add(j.b, j.anchor_b, force);
    std::optional<double> length = length_of(joint);
    if (!length) length = rope_length_of(joint);
    if (!length) continue;
    for (const int body : {j.a, j.b}) {  // K of a taut rod across it: force/length
      if (is_fixed(scene, body)) continue;
      const double r = force / (*length * scene.bodies[index(body)].mass);
      if (r > most.first) most = {r, body};
    }
  }
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (scene.bodies[i].is_static) continue;
    const double r = k[i].cwiseQuotient(scene.bodies[i].inertia).maxCoeff();
    if (r > most.first) most = {r, static_cast<int>(i)};
  }
  return most;
}

/// N of the first frame.
int wanted_at_start(const Scene& scene, Settings settings) {
  settings.mode = Mode::kAdaptive;
  settings.policy = Policy::kFrame;
  settings.n_max = 1;  // only its probe is of interest
  settings.probe = true;
  Simulator simulator(std::make_shared<const Scene>(scene));
  simulator.set_settings(settings);
  return simulator.step().n_wanted;
}

}  // namespace

Forecast forecast(const Scene& scene, const Settings& settings) {
  Forecast result;
  if (!is_runnable(scene)) return result;
  result.mass_ratio = mass_ratio(scene);
  result.at_start = wanted_at_start(scene, settings);
  const auto [r, body] = hanging_bound(scene);
  result.hanging = wanted_substeps(scene.frame, stable_step(settings.alpha, r));
  result.body = body;
  return result;
}

}  // namespace substep
