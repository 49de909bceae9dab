#include "texts.hpp"

#include <vector>

#include "case/case_keys.hpp"
#include "io/text/text.hpp"

namespace holdfast::program {
namespace {

/// What an option's value can be completed with.
enum class Completed { nothing, words, files, key };

struct OptionWords {
  std::string name;  // "--switching"
  std::string description;
  bool takes_value;
  Completed completed;
  std::string words;  // "sampled exact"
};

/// The words of "TEXT:{sampled,exact}", separated by blanks.
std::string listed_words(const std::string& type) {
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return "";
  std::string words = type.substr(begin + 1, end - begin - 1);
  for (char& character : words)
    if (character == ',') character = ' ';
  return words;
}

OptionWords words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  OptionWords result{option.get_name(), one_line(option.get_description()),
                     option.get_expected_max() > 0 && option.get_type_size() > 0,
                     Completed::nothing, listed_words(type)};
  if (!result.words.empty()) result.completed = Completed::words;
  if (type.rfind("FILE", 0) == 0 || type.rfind("FOLDER", 0) == 0 || type.rfind("DIRECTORY", 0) == 0)
    result.completed = Completed::files;
  if (result.name == "--set" || result.name == "--axis") result.completed = Completed::key;
  return result;
}

std::vector<OptionWords> options_of(const CLI::App& job) {
  std::vector<OptionWords> options;
  for (const CLI::Option* option : job.get_options())
    if (!option->get_group().empty()) options.push_back(words_of(*option));
  return options;
}

std::string all_keys() {
  std::string keys;
  for (const CaseKey& key : case_keys()) keys += (keys.empty() ? "" : " ") + key.name + "=";
  return keys;
}

std::string job_names(const CLI::App& program) {
  std::string names;
  for (const CLI::App* job : program.get_subcommands(nullptr))
    names += (names.empty() ? "" : " ") + job->get_name();
  return names;
}

bool has_name(const OptionWords& option) { return option.name.front() == '-'; }

/// What bash says to the word behind an option; one without a name stands behind the job.
std::string bash_value(const std::string& job, const OptionWords& option) {
  const std::string pattern = "    " + job + ":" + (has_name(option) ? option.name : job) + ") ";
  switch (option.completed) {
    case Completed::words:
      return pattern + "COMPREPLY=($(compgen -W \"" + option.words + "\" -- \"$word\")) ;;\n";
    case Completed::files:
      return pattern + "COMPREPLY=($(compgen -f -- \"$word\")) ;;\n";
    case Completed::key:
      return pattern + "compopt -o nospace; COMPREPLY=($(compgen -W \"$keys\" -- \"$word\")) ;;\n";
    case Completed::nothing:
      return pattern + "COMPREPLY=() ;;\n";
  }
  return "";
}

/// In single quotes of zsh's _arguments, where brackets and colons have a meaning.
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
  if (option.takes_value) {
    text += ":value:";
    if (option.completed == Completed::words) text += "(" + option.words + ")";
    if (option.completed == Completed::files) text += "_files";
    if (option.completed == Completed::key) text += "_holdfast_keys";
  }
  return text + "'";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string values, options;
  for (const CLI::App* job : program.get_subcommands(nullptr)) {
    options += "    " + job->get_name() + ") options=\"";
    std::string names;
    for (const OptionWords& option : options_of(*job)) {
      if (has_name(option)) names += (names.empty() ? "" : " ") + option.name;
      if (option.takes_value) values += bash_value(job->get_name(), option);
    }
    options += names + "\" ;;\n";
  }
  return "# bash completion of holdfast\n"
         "_holdfast() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local job=${COMP_WORDS[1]} options\n"
         "  local keys=\"" +
         all_keys() +
         "\"\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \"" +
         job_names(program) +
         " --help --version\" -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case $job:$before in\n" +
         values +
         "    *)\n"
         "  case $job in\n" +
         options +
         "  esac\n"
         "      COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -F _holdfast holdfast\n";
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
  return "#compdef holdfast\n"
         "_holdfast_keys() {\n"
         "  compadd -S '' -- " +
         all_keys() +
         "\n}\n"
         "_holdfast() {\n"
         "  local -a jobs\n"
         "  jobs=(\n" +
         jobs +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe job jobs\n"
         "    return\n"
         "  fi\n"
         "  local job=$words[2]\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $job in\n" +
         arguments +
         "  esac\n"
         "}\n"
         "_holdfast \"$@\"\n";
}

}  // namespace holdfast::program
