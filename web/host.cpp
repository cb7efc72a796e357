#include "web/host.hpp"

#include <emscripten.h>
#include <imgui.h>

#include <cstdlib>

// The bodies are JavaScript.
// clang-format off
EM_JS(void, host_link_changed, (), { Module["host"].linkChanged(); })
EM_JS(void, host_copy_link, (const char* more), { Module["host"].copyLink(UTF8ToString(more)); })
EM_JS(void, host_copy_embed, (), { Module["host"].copyEmbed(); })
EM_JS(void, host_open_article, (), { Module["host"].openArticle(); })
EM_JS(void, host_copy_text, (const char* text), { Module["host"].copyText(UTF8ToString(text)); })
EM_JS(void, host_open_file, (), { Module["host"].openFile(); })
EM_JS(void, host_save_file, (const char* name, const char* bytes, int size), {
  Module["host"].saveFile(UTF8ToString(name), HEAPU8.slice(bytes, bytes + size));
})
EM_JS(void, host_record, (int on), { Module["host"].record(on !== 0); })
EM_JS(void, host_remember, (const char* key, const char* value), {
  Module["host"].remember(UTF8ToString(key), UTF8ToString(value));
})
EM_JS(char*, host_text, (const char* call, const char* a, const char* b), {
  const text = Module["host"][UTF8ToString(call)](UTF8ToString(a), UTF8ToString(b));
  const size = lengthBytesUTF8(text) + 1;
  const memory = _malloc(size);
  stringToUTF8(text, memory, size);
  return memory;
})
// clang-format on

namespace substep::web {
namespace {

// The last pasted text: the page sets it before it sends the key.
std::string pasted;

std::string text_of_page(const char* call, const std::string& a, const std::string& b = "") {
  char* text = host_text(call, a.c_str(), b.c_str());
  std::string copy(text);
  std::free(text);
  return copy;
}

}  // namespace

Host page_host() {
  Host host;
  host.link_changed = [](const std::string&) { host_link_changed(); };
  host.copy_link = [](const std::string& more) { host_copy_link(more.c_str()); };
  host.copy_embed = host_copy_embed;
  host.open_article = host_open_article;
  host.open_file = host_open_file;
  host.save_file = [](const std::string& name, const std::string& bytes) {
    host_save_file(name.c_str(), bytes.data(), static_cast<int>(bytes.size()));
  };
  host.record = [](bool on) { host_record(on ? 1 : 0); };
  host.remember = [](const std::string& key, const std::string& value) {
    host_remember(key.c_str(), value.c_str());
  };
  host.recall = [](const std::string& key) { return text_of_page("recall", key); };
  host.ask = [](const std::string& name, const std::string& value) {
    return text_of_page("ask", name, value);
  };
  return host;
}

void use_page_clipboard() {
  ImGuiIO& io = ImGui::GetIO();
  io.SetClipboardTextFn = [](void*, const char* text) { host_copy_text(text); };
  io.GetClipboardTextFn = [](void*) { return pasted.c_str(); };
}

}  // namespace substep::web

extern "C" EMSCRIPTEN_KEEPALIVE void substep_pasted(const char* text) {
  substep::web::pasted = text;
}
