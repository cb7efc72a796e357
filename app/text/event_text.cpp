// The packed events of a link. A version, then for every event its kind with the number of frames
// since the previous one (a variable-length integer) and its values:
//
//   ball      length codes of eight doubles in four bytes, then their bytes
//   effects   a bit each
//   grab      body, length codes of the anchor, its bytes, then the target
//   move      the target, as its difference from the last one
//   let go    nothing
//   settings  length and text of those that change: "alpha:0.2,n:5"
//
// A double is its leading bytes up to the last that is not zero; code 9 repeats the previous
// ball's. Targets count steps of 1/65536 m, see hand_target().
#include "app/text/event_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/lab/overrides.hpp"
#include "app/text/byte_text.hpp"
#include "app/text/letters.hpp"
#include "core/model/effects.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/setting_fields.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

constexpr std::uint8_t kVersion = 1;
enum Kind : std::uint8_t { kBall, kSwitch, kGrab, kMove, kLetGo, kSettings, kKinds };
constexpr unsigned kKindBits = 3;
constexpr std::int64_t kMostFrames = 100'000'000;
constexpr std::size_t kMostCopies = 12'000;  // limit on body copies by balls and switched effects
constexpr double kGrid = 65536.0;            // of targets [1/m]

using Ballistics = std::array<double, 8>;

Ballistics values_of(const Ball& b) {
  return {b.position.x(), b.position.y(), b.position.z(), b.velocity.x(),
          b.velocity.y(), b.velocity.z(), b.radius,       b.mass};
}

Ball ball_of(const Ballistics& v) { return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], v[7]}; }

std::array<std::int64_t, 3> steps_of(const Vec3& target) {
  return {std::llround(kGrid * target.x()), std::llround(kGrid * target.y()),
          std::llround(kGrid * target.z())};
}

/// @return error message, or ""
std::string apply_changes(std::string_view text, Settings& settings) {
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find(','));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
    const std::size_t colon = std::min(pair.find(':'), pair.size());
    const SettingField* field = find_setting(pair.substr(0, colon));
    if (field == nullptr) return "changes an unknown setting";
    const std::string_view value = pair.substr(std::min(colon + 1, pair.size()));
    if (const auto problem = set_setting(*field, value, settings)) {
      return std::string(field->name) + " " + *problem;
    }
  }
  return "";
}

/// Writes events one by one, as differences from the previous ones.
class EventWriter {
 public:
  explicit EventWriter(const Settings& start) : settings_(start) { out_.bytes.push_back(kVersion); }

  void add(const RunEvent& event) {
    std::visit([&](const auto& what) { write(event.frame, what); }, event.what);
  }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return out_.bytes; }

 private:
  void head(std::int64_t frame, Kind kind) {
    out_.whole(static_cast<std::uint64_t>(frame - frame_) << kKindBits | kind);
    frame_ = frame;
  }
  void write(std::int64_t frame, const Ball& ball) {
    head(frame, kBall);
    const Ballistics values = values_of(ball);
    out_.doubles(values, last_ball_ ? &*last_ball_ : nullptr);
    last_ball_ = values;
  }
  void write(std::int64_t frame, const Effects& effects) {
    head(frame, kSwitch);
    unsigned bits = 0;
    for (std::size_t i = 0; i < kEffects.size(); ++i) {
      bits |= (effects.*kEffects[i].member ? 1U : 0U) << i;
    }
    out_.whole(bits);
  }
  void write(std::int64_t frame, const Pull& pull) {
    const bool moved = held_ && held_->body == pull.body && held_->anchor == pull.anchor;
    head(frame, moved ? kMove : kGrab);
    if (!moved) {
      out_.whole(static_cast<std::uint64_t>(pull.body));
      out_.doubles<3>({pull.anchor.x(), pull.anchor.y(), pull.anchor.z()}, nullptr);
    }
    const auto from = steps_of(moved ? held_->target : Vec3(Vec3::Zero()));
    const auto to = steps_of(pull.target);
    for (std::size_t i = 0; i < 3; ++i) out_.difference(to[i] - from[i]);
    held_ = pull;
  }
  void write(std::int64_t frame, const LetGo& /*nothing*/) {
    head(frame, kLetGo);
    held_.reset();
  }
  void write(std::int64_t frame, const Settings& settings) {
    head(frame, kSettings);
    const Overrides changes = differences(settings, settings_);
    const std::string text = changes.empty() ? "" : overrides_text({changes});
    out_.whole(text.size());
    out_.bytes.insert(out_.bytes.end(), text.begin(), text.end());
    settings_ = settings;
  }

  ByteWriter out_;
  Settings settings_;
  std::optional<Ballistics> last_ball_;
  std::optional<Pull> held_;
  std::int64_t frame_ = 0;
};

/// Reads events one by one, relative to the previous ones.
class EventReader {
 public:
  EventReader(ByteReader& in, const Scene& scene, const Settings& start)
      : in_(in), scene_(scene), settings_(start) {}

  /// @param problem error message, or ""
  RunEvent event(std::string& problem) {
    const std::uint64_t head = in_.whole();
    const std::uint64_t frames = head >> kKindBits;
    if (frames > static_cast<std::uint64_t>(kMostFrames)) problem = "is too late in the run";
    frame_ += problem.empty() ? static_cast<std::int64_t>(frames) : 0;
    if (frame_ > kMostFrames) problem = "is too late in the run";
    RunEvent event{frame_, LetGo{}};
    switch (head & ((1U << kKindBits) - 1U)) {
      case kBall:
        event.what = ball(problem);
        break;
      case kSwitch:
        event.what = effects();
        break;
      case kGrab:
        event.what = grab(problem);
        break;
      case kMove:
        event.what = move(problem);
        break;
      case kLetGo:
        held_.reset();
        break;
      case kSettings:
        problem = apply_changes(in_.text(static_cast<std::size_t>(
                                    std::min<std::uint64_t>(in_.whole(), kMostEventText))),
                                settings_);
        event.what = settings_;
        break;
      default:
        problem = "has an unknown kind";
    }
    return event;
  }

 private:
  Ball ball(std::string& problem) {
    ballistics_ = in_.doubles(balls_ > 0 ? &ballistics_ : nullptr);
    ++balls_;
    Ball ball = ball_of(ballistics_);
    const Problems wrong = check_values(with_ball(Scene{}, ball, 0));
    if (in_.ok() && !wrong.empty()) problem = "has an invalid ball: " + to_string(wrong.front());
    return ball;
  }
  Effects effects() {
    Effects effects;
    const std::uint64_t bits = in_.whole();
    for (std::size_t i = 0; i < kEffects.size(); ++i) {
      effects.*kEffects[i].member = (bits >> i & 1U) != 0;
    }
    return effects;
  }
  Pull grab(std::string& problem) {
    const std::uint64_t body = in_.whole();
    const auto anchor = in_.doubles<3>(nullptr);
    const std::size_t own = scene_.bodies.size();
    const std::size_t count = own + std::min<std::size_t>(balls_, Ball::kMost);
    if (body >= count || (body < own && scene_.bodies[static_cast<std::size_t>(body)].is_static)) {
      problem = "pulls a body that does not move";
    }
    for (const double x : anchor) {
      if (!kPositionRange.contains(x)) problem = "pulls at a point outside all bodies";
    }
    held_ = Pull{problem.empty() ? static_cast<int>(body) : 0, {anchor[0], anchor[1], anchor[2]}};
    steps_ = {};
    return move(problem);
  }
  Pull move(std::string& problem) {
    if (!held_) {
      problem = "moves a pull that has not begun";
      return {};
    }
    const double most = kGrid * kPositionRange.most;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto step = static_cast<double>(in_.difference()) + static_cast<double>(steps_[i]);
      if (!(std::abs(step) <= most)) {
        problem = "pulls too far away";
        return {};
      }
      steps_[i] = std::llround(step);
      held_->target[static_cast<int>(i)] = static_cast<double>(steps_[i]) / kGrid;
    }
    return *held_;
  }

  ByteReader& in_;
  const Scene& scene_;
  Settings settings_;
  std::int64_t frame_ = 0;
  std::size_t balls_ = 0;
  Ballistics ballistics_{};
  std::optional<Pull> held_;
  std::array<std::int64_t, 3> steps_{};
};

}  // namespace

bool fits_link(std::span<const RunEvent> events, const Scene& scene) {
  const auto copies = std::count_if(events.begin(), events.end(), [](const RunEvent& event) {
    return std::holds_alternative<Ball>(event.what) || std::holds_alternative<Effects>(event.what);
  });
  return static_cast<std::size_t>(copies) * (scene.bodies.size() + Ball::kMost) <= kMostCopies;
}

std::string events_text(std::span<const RunEvent> events, const Settings& start) {
  EventWriter writer(start);
  for (const RunEvent& event : events) writer.add(event);
  return to_letters(writer.bytes());
}

std::vector<RunEvent> read_events(std::string_view text, const Scene& scene, const Settings& start,
                                  std::string& problem) {
  const auto bytes = text.size() <= kMostEventText ? from_letters(text) : std::nullopt;
  if (text.size() > kMostEventText) {
    problem = "has more than " + std::to_string(kMostEventText) + " characters";
  } else if (!bytes || bytes->empty()) {
    problem = "cannot be decoded: was the link truncated?";
  } else if (bytes->front() != kVersion) {
    problem = "is of a later version of this program";
  }
  if (!problem.empty()) return {};
  ByteReader in(*bytes);
  in.byte();
  EventReader reader(in, scene, start);
  std::vector<RunEvent> events;
  while (!in.done()) {
    events.push_back(reader.event(problem));
    if (!in.ok()) problem = "ends within an event: was the link truncated?";
    if (problem.empty()) continue;
    if (in.ok()) problem = "event " + std::to_string(events.size()) + " " + problem;
    return {};
  }
  if (!fits_link(events, scene)) problem = "has more balls than a scene of this size may have";
  if (!problem.empty()) events.clear();
  return events;
}

}  // namespace substep
