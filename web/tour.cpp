// The guided tour for the page, which shows its text as HTML, see web/tour.mjs.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/text/tour_words.hpp"
#include "web/api.hpp"
#include "web/instance.hpp"

using nlohmann::json;
using substep::TourPart;
using substep::web::instance;

namespace {

// The target of a reference: its panel and its handle (substep_widgets).
json place_of(const TourPart& part) {
  for (const substep::TourPlace& place : substep::tour_places()) {
    if (place.name != part.name) continue;
    return {{"text", part.text},
            {"panel", place.panel},
            {"group", place.group},
            {"label", place.label}};
  }
  return {{"text", part.text}};
}

json sentence(const std::vector<TourPart>& parts) {
  json list = json::array();
  for (const TourPart& part : parts) {
    if (part.kind == TourPart::Kind::kNumber) {
      list.push_back({{"number", part.name}});
    } else if (part.kind == TourPart::Kind::kPlace) {
      list.push_back(place_of(part));
    } else {
      list.push_back({{"text", part.text}});
    }
  }
  return list;
}

json numbers(const std::vector<substep::TourNumber>& all) {
  json list = json::object();
  for (const substep::TourNumber& n : all) {
    list[n.name] = {{"label", n.label},
                    {"value", n.value},
                    {"text", n.text},
                    {"stops", n.stops},
                    {"from_start", n.from_start}};
  }
  return list;
}

}  // namespace

extern "C" {

const char* substep_tour() {
  static std::string text;
  const substep::App& app = *instance->app;
  if (app.desk.tour < 0) return "null";
  const substep::TourWords words =
      tour_words(app, static_cast<std::size_t>(app.desk.tour), app.tour.loop());
  text = json{{"step", words.step + 1},
              {"count", words.count},
              {"title", words.title},
              {"text", sentence(words.text)},
              {"watch", sentence(words.watch)},
              {"task", sentence(words.task)},
              {"numbers", numbers(words.numbers)},
              {"now", words.now},
              {"reply", words.reply.text},
              {"done", words.reply.done}}
             .dump();
  return text.c_str();
}

void substep_tour_in_page(int on) { instance->app->desk.tour_in_page = on != 0; }

int substep_dark() { return instance->app->desk.dark ? 1 : 0; }

}  // extern "C"
