#include "core/import/mjcf_model.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

class EqualityReader {
 public:
  EqualityReader(const MjcfContext& context, MjcfModel& model)
      : context_(context), model_(model), poses_(reference_poses(model.mechanism)) {}

  void read(const XmlElement& element) {
    const std::string place = context_.document.place(element);
    if (element.name != "connect" && element.name != "weld") {
      return context_.report.left_out.add(place, "<equality> of kind '" + element.name + "'");
    }
    MjcfAttributes in(context_, element);
    in.ignore({"solref", "solimp", "torquescale", "body1", "body2", "anchor", "relpose"});
    context_.report.approximated.add(place, "an equality constraint is rigid");
    if (!in.flag("active", true)) {
      return context_.report.left_out.add(place, "a constraint that is not active");
    }
    LinkLoop loop;
    loop.kind = element.name == "weld" ? LinkLoop::Kind::kWeld : LinkLoop::Kind::kBall;
    loop.place = place;
    loop.name = in.text_or("name", element.name);
    const bool is_read =
        in.text("site1") != nullptr ? between_sites(in, loop) : between_bodies(in, loop);
    if (is_read) model_.mechanism.loops.push_back(std::move(loop));
  }

 private:
  bool between_sites(MjcfAttributes& in, LinkLoop& loop) {
    for (const bool first : {true, false}) {
      const std::string name = in.text_or(first ? "site1" : "site2", "");
      const auto site = model_.sites.find(name);
      if (site == model_.sites.end()) {
        in.error("no site is called '" + name + "'");
        return false;
      }
      (first ? loop.a : loop.b) = site->second.link;
      (first ? loop.on_a : loop.on_b) = site->second.pose;
    }
    return true;
  }

  bool between_bodies(MjcfAttributes& in, LinkLoop& loop) {
    for (const bool first : {true, false}) {
      const std::string name = in.text_or(first ? "body1" : "body2", "world");
      const auto body = model_.bodies.find(name);
      if (body == model_.bodies.end()) {
        in.error("no body is called '" + name + "'");
        return false;
      }
      (first ? loop.a : loop.b) = body->second;
    }
    const Vec3 anchor = in.vector("anchor", Vec3::Zero(), kPositionRange);
    const Pose a = pose_of(loop.a);
    const Pose b = pose_of(loop.b);
    if (loop.kind == LinkLoop::Kind::kBall) {
      loop.on_a.position = anchor;
      loop.on_b.position = b.inverse() * (a * anchor);
      return true;
    }
    loop.on_b.position = anchor;
    const std::vector<double> relative = in.numbers("relpose", 7, 7, kPositionRange);
    const bool is_given = !relative.empty() && (relative[3] != 0.0 || relative[4] != 0.0 ||
                                                relative[5] != 0.0 || relative[6] != 0.0);
    Pose b_in_a = a.inverse() * b;
    if (is_given) {
      b_in_a = {Vec3(relative.data()),
                Quat(relative[3], relative[4], relative[5], relative[6]).normalized()};
    }
    loop.on_a = b_in_a * loop.on_b;
    return true;
  }

  [[nodiscard]] Pose pose_of(int link) const { return link < 0 ? Pose() : poses_[index(link)]; }

  const MjcfContext& context_;
  MjcfModel& model_;
  std::vector<Pose> poses_;
};

}  // namespace

void read_equality(const MjcfContext& context, MjcfModel& model) {
  EqualityReader reader(context, model);
  for (const XmlElement& section : context.document.root.children) {
    if (section.name != "equality") continue;
    for (const XmlElement& element : section.children) reader.read(element);
  }
}

}  // namespace substep
