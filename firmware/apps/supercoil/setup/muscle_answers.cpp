#include "apps/supercoil/setup/muscle_answers.hpp"

#include "config/toml_file.hpp"

namespace supercoil::operating {

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
    root.finish();
  }
  if (!diagnostics.empty()) return tl::unexpected(config::to_text(diagnostics.problems()));
  return script;
}

}  // namespace supercoil::operating
