#pragma once
#include <string>
#include <vector>

#include "config/exhibit.h"
#include "config/scene.h"

namespace eddy {

/// What the command line has in place of the exhibit's scene, and on top of it.
struct SceneOrders {
    std::string scene{};  ///< empty: the exhibit's
    std::vector<std::string> set{};
    std::vector<SolverPreset> presets{};  ///< empty: the exhibit's
};

/// The files that a configuration is made of, as they were read.
struct ConfigFiles {
    ExhibitFiles exhibit;
    std::vector<WrittenFile> scene{};   ///< the scene's file and its sum, if it is no shipped scene
    std::vector<WrittenFile> refers{};  ///< what the scene names: meshes, paths, flows
    std::vector<std::string> keys{};    ///< of the scene, under which it names them: as many
};

/// A configuration read once, and everything that is wrong with it. What the caller builds comes from here, so that what was
/// checked is what runs.
struct ConfigSet {
    ConfigFiles files;
    std::string hash;  ///< SHA-256 over all of the files; of the factory's settings: 64 noughts
    LoadedExhibit exhibit{};
    LoadedScene scene{};
    std::vector<Diagnostic> diagnostics{};

    bool good() const { return diagnostics.empty(); }
};

inline const std::string kFactoryHash(64, '0');

/// Files that a scene names may have so many bytes, all together.
inline constexpr std::size_t kMostReferredBytes = 64 << 20;

/// Reads and checks a folder. Never throws for what is in it. Safe on any thread.
ConfigSet read_config_set(const std::filesystem::path& folder, const SceneOrders& orders);

/// The same from files read earlier; what the scene names lies at `refers` now, one for each of files.refers.
ConfigSet config_set_of(const ConfigFiles& files, const SceneOrders& orders,
                        const std::vector<std::filesystem::path>& refers);

/// What the binary ships, with no file. Only the orders can be wrong with it.
ConfigSet factory_set(const SceneOrders& orders);

}  // namespace eddy
