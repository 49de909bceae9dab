#include "texts.hpp"

#include "case/case_keys.hpp"
#include "case/device/device_keys.hpp"

namespace holdfast::program {
namespace {

/// Option, and the shell code that completes its value in bash and zsh.
struct OptionWords {
  std::string name;  // "--switching"
  std::string description;
  bool takes_value;
  std::string bash, zsh;
};

/// The words of "TEXT:{sampled,exact}", separated by blanks.
std::string listed_words(const std::string& type) {
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return "";
  return replaced(type.substr(begin + 1, end - begin - 1), ",", " ");
}

OptionWords words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name(), words = listed_words(type);
  OptionWords result{option.get_name(), one_line(option.get_description()),
                     option.get_expected_max() > 0 && option.get_type_size() > 0, "COMPREPLY=()",
                     ""};
  if (result.name == "--set" || result.name == "--axis") {
    result.bash = "compopt -o nospace; COMPREPLY=($(compgen -W \"$keys\" -- \"$word\"))";
    result.zsh = "_holdfast_keys";
  } else if (type.rfind("FILE", 0) == 0) {
    result.bash = "COMPREPLY=($(compgen -f -- \"$word\"))";
    result.zsh = "_files";
  } else if (!words.empty()) {
    result.bash = "COMPREPLY=($(compgen -W \"" + words + "\" -- \"$word\"))";
    result.zsh = "(" + words + ")";
  }
  return result;
}

std::vector<OptionWords> options_of(const CLI::App& job) {
  std::vector<OptionWords> options;
  for (const CLI::Option* option : job.get_options())
    if (!option->get_group().empty()) options.push_back(words_of(*option));
  return options;
}

/// Keys of a case; device keys only for the first device.
std::string all_keys() {
  std::string keys;
  for (const CaseKey& key : case_keys()) keys += (keys.empty() ? "" : " ") + key.name + "=";
  for (const DeviceKey& key : device_keys()) keys += " " + device_key_text(1, key.name) + "=";
  return keys;
}

bool has_name(const OptionWords& option) { return option.name.front() == '-'; }

/// Text in single quotes for zsh's _arguments, with brackets and colons escaped.
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char character : text) {
    if (character == '\'')
      safe += "'\\''";
    else if (character == '[' || character == ']' || character == ':' || character == '\\')
      safe += std::string("\\") + character;
    else
      safe += character;
  }
  return safe;
}

std::string zsh_argument(const OptionWords& option) {
  std::string text = "        '";
  text += has_name(option) ? "*" + option.name + "[" + zsh_text(option.description) + "]" : "1";
  return text + (option.takes_value ? ":value:" + option.zsh : "") + "'";
}

}  // namespace

std::vector<std::string> job_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* job : program.get_subcommands(nullptr)) names.push_back(job->get_name());
  return names;
}

std::string bash_completion(const CLI::App& program) {
  std::string values, options;
  for (const CLI::App* job : program.get_subcommands(nullptr)) {
    options += "    " + job->get_name() + ") options=\"";
    std::string names;
    for (const OptionWords& option : options_of(*job)) {
      if (has_name(option)) names += (names.empty() ? "" : " ") + option.name;
      // An option without a name stands behind the job.
      const std::string& before = has_name(option) ? option.name : job->get_name();
      if (option.takes_value)
        values += "    " + job->get_name() + ":" + before + ") " + option.bash + " ;;\n";
    }
    options += names + "\" ;;\n";
  }
  return program_text("bash", {{"keys", all_keys()},
                               {"jobs", CLI::detail::join(job_names(program), " ")},
                               {"values", values},
                               {"options", options}});
}

std::string zsh_completion(const CLI::App& program) {
  std::string jobs, arguments;
  for (const CLI::App* job : program.get_subcommands(nullptr)) {
    jobs += "    '" + job->get_name() + ":" + zsh_text(one_line(job->get_description())) + "'\n";
    arguments += "    " + job->get_name() + ")\n      _arguments \\\n";
    const std::vector<OptionWords> options = options_of(*job);
    for (std::size_t k = 0; k < options.size(); ++k)
      arguments += zsh_argument(options[k]) + (k + 1 < options.size() ? " \\\n" : "\n");
    arguments += "      ;;\n";
  }
  return program_text("zsh", {{"keys", all_keys()}, {"jobs", jobs}, {"arguments", arguments}});
}

}  // namespace holdfast::program
