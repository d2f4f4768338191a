#include "tests/config/whole_schema.h"

#include "config/scene_check.h"
#include "config/scene_schema.h"
#include "tests/config/complaints.h"

namespace eddy {

LoadedScene read_whole(const std::string& text) {
    const Node document = parse_toml(text, "s.toml");
    LoadedScene loaded;
    Findings findings;
    read_document(document, loaded.scene, findings);
    resolve(loaded.scene, findings.origins, "");
    check(loaded.scene, findings);
    if (!findings.diagnostics.empty()) throw ConfigError(std::move(findings.diagnostics));
    loaded.origins = std::move(findings.origins);
    return loaded;
}

std::vector<std::string> faults_of(const std::string& text) {
    return complaints([&] { read_whole(text); });
}

}  // namespace eddy
