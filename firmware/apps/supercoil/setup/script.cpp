#include "apps/supercoil/setup/script.hpp"

#include "config/toml_file.hpp"

namespace supercoil::operating {

namespace {

Nameplate read_nameplate(config::Section section) {
  Nameplate nameplate;
  for (std::size_t i = 0; i < nameplate_questions.size(); ++i) {
    const Question& q = nameplate_questions[i];
    nameplate.set(i, std::isnan(q.fallback) ? section.required_number(q.key, q.allowed)
                                            : section.number(q.key, q.fallback, q.allowed));
  }
  section.finish();
  return nameplate;
}

}  // namespace

tl::expected<Script, std::string> read_script(const std::string& path) {
  config::Diagnostics diagnostics(path);
  const std::string text = config::read_text(path, diagnostics);
  Script script;
  if (diagnostics.empty()) {
    const toml::table document = config::parse(text, diagnostics);
    config::Section root(&document, "", diagnostics);
    config::Section muscle = root.section("muscle");
    for (std::size_t i = 0; i < questions.size(); ++i) {
      const Question& q = questions[i];
      // An absent key is known nevertheless: to be meant by a misspelt one.
      if (muscle.has(q.key)) {
        script.muscle.set(i, muscle.number(q.key, NAN, q.allowed));
      } else {
        muscle.allow({q.key});
      }
    }
    script.take_gains = muscle.number(take_gains.key, take_gains.fallback, take_gains.allowed);
    muscle.finish();
    if (root.has("nameplate")) {
      script.nameplate = read_nameplate(root.section("nameplate"));
    } else {
      root.allow({"nameplate"});
    }
    root.finish();
  }
  if (!diagnostics.empty()) return tl::unexpected(config::to_text(diagnostics.problems()));
  return script;
}

}  // namespace supercoil::operating
