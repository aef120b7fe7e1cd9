// isoatlas completion: a completion script, generated from the parser itself.
#include <fmt/format.h>

#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {

int run_completion(const Arguments& arguments, Terminal& terminal) {
    if (arguments.file != "bash") {
        throw Error(
            ErrorKind::usage,
            {.what = "no completion for the shell \"" + arguments.file + "\"", .expected = "bash", .next = "isoatlas completion bash"});
    }
    std::string names, cases;
    for (const Verb& verb : verbs()) {
        names += verb.name + " ";
        std::string options;
        for (const std::string& option : options_of(verb.name)) options += option + " ";
        cases += fmt::format("        {}) words=\"{}\" ;;\n", verb.name, options);
    }
    terminal.out() << "# isoatlas completion for bash: source <(isoatlas completion bash)\n"
                      "_isoatlas() {\n"
                      "    local word=\"${COMP_WORDS[COMP_CWORD]}\" words=\"\"\n"
                      "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
                      "        COMPREPLY=($(compgen -W \""
                   << names
                   << "help\" -- \"$word\"))\n"
                      "        return\n"
                      "    fi\n"
                      "    case \"${COMP_WORDS[1]}\" in\n"
                   << cases
                   << "    esac\n"
                      "    case \"$word\" in\n"
                      "        -*) COMPREPLY=($(compgen -W \"$words\" -- \"$word\")) ;;\n"
                      "        *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
                      "    esac\n"
                      "}\n"
                      "complete -o filenames -F _isoatlas isoatlas\n";
    return 0;
}

}  // namespace isoatlas::cli
