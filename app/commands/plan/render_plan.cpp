#include "app/commands/plan/render_plan.h"

#include "app/commands/common.h"
#include "app/commands/json_output.h"
#include "app/commands/render/layers.h"
#include "core/files.h"
#include "io/project/json_fields.h"
#include "io/project/scene_hash.h"
#include "io/project/settings_json.h"
#include "render/film/sample_allocation.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace blush {
namespace {

constexpr uint64_t max_plan_bytes = uint64_t(1) << 30;
constexpr size_t max_entries = 1 << 22;
constexpr int64_t max_samples = int64_t(1) << 40;

constexpr const char* about =
    "A render plan of Blush. `tasks` are the lines of commands.txt; each renders the samples [first, last) of a look into a file below "
    "parts. With adaptive sampling the first tasks are its pilot; `allocation` of a look is the hash of the file below allocations.";

Error wrong(std::string where, std::string what = "missing, of the wrong type or out of range") {
    return Error{.what = std::move(what), .where = std::move(where)};
}

const Json& member_of(const Json& json, const char* key) {
    static const Json none;
    const auto found = json.find(key);
    return found == json.end() ? none : *found;
}

OrderedJson parsed_text(const std::string& json) { return OrderedJson::parse(json, nullptr, false); }

// ---- reading

Result<PlanLook> read_look(const Json& json, const RenderPlan& plan, const std::string& where) {
    PlanLook look;
    if (!json.is_object()) return wrong(where);
    if (!read_json(member_of(json, "name"), look.name) || !is_safe_name(look.name))
        return wrong(where + ".name", "not a name of letters, digits, '.', '_' and '-'");
    if (!read_json(member_of(json, "scene"), look.scene) || look.scene >= plan.scenes.size()) return wrong(where + ".scene");
    if (!read_json(member_of(json, "lights_hash"), look.lights_hash)) return wrong(where + ".lights_hash");
    if (const Json& sequence = member_of(json, "sequence"); !sequence.is_null())
        if (!read_json(sequence, look.sequence) || !is_safe_name(look.sequence)) return wrong(where + ".sequence");
    if (!read_json(member_of(json, "finished"), look.finished)) return wrong(where + ".finished");
    if (const Json& edits = member_of(json, "edits"); edits.is_object())
        look.edits = json_text(edits);
    else if (!edits.is_null())
        return wrong(where + ".edits");
    const Json& words = member_of(json, "set");
    if (!words.is_object()) return wrong(where + ".set");
    for (const auto& [key, value] : words.items())
        if (!read_json(value, look.words[key])) return wrong(where + ".set." + key);
    const Json& settings = member_of(json, "settings");
    if (!settings.is_object()) return wrong(where + ".settings");
    const Result<ParsedSettings<RenderSettings>> parsed = parse_render_settings(json_text(settings));
    if (!parsed) return wrong(where + ".settings", parsed.error().text());
    look.settings = parsed->settings;
    if (look.settings.first_sample != 0 || look.settings.seconds > 0 || look.settings.error > 0)
        return wrong(where + ".settings", "stop rules are not part of a look");
    if (look.settings.adaptive != plan.samples_adaptively(look.settings))
        return wrong(where + ".settings", "adaptive sampling differs from that of the plan");
    if (const Json& allocation = member_of(json, "allocation"); !allocation.is_null())
        if (!read_json(allocation, look.allocation) || !look.settings.adaptive) return wrong(where + ".allocation");
    return look;
}

Result<PlanTask> read_task(const Json& json, const std::vector<PlanLook>& looks, const std::map<std::string, size_t>& index_of,
                           const std::string& where) {
    PlanTask task;
    std::string name;
    if (!json.is_object() || !read_json(member_of(json, "look"), name) || !index_of.contains(name)) return wrong(where + ".look");
    task.look = index_of.at(name);
    const Json& samples = member_of(json, "samples");
    const bool numbers =
        samples.is_array() && samples.size() == 2 && read_json(samples[0], task.samples.first) && read_json(samples[1], task.samples.last);
    if (!numbers || task.samples.first < 0 || task.samples.first >= task.samples.last || task.samples.last > max_samples)
        return wrong(where + ".samples");
    if (looks[task.look].settings.adaptive && end_of_task(looks[task.look], task.samples.first, max_samples) < task.samples.last)
        return wrong(where + ".samples", "neither within a half of the pilot nor behind it");
    return task;
}

Result<void> read_scenes(const Json& json, RenderPlan& plan) {
    const Json& scenes = member_of(json, "scenes");
    if (!scenes.is_array() || scenes.empty() || scenes.size() > max_entries) return wrong("scenes");
    for (const Json& item : scenes) {
        PlanScene scene;
        if (!item.is_object() || !read_json(member_of(item, "file"), scene.file) || !read_json(member_of(item, "hash"), scene.hash))
            return wrong(fmt::format("scenes[{}]", plan.scenes.size()));
        plan.scenes.push_back(std::move(scene));
    }
    return {};
}

Result<void> read_looks_and_tasks(const Json& json, RenderPlan& plan) {
    const Json &looks = member_of(json, "looks"), &tasks = member_of(json, "tasks");
    if (!looks.is_array() || looks.empty() || looks.size() > max_entries) return wrong("looks");
    if (!tasks.is_array() || tasks.size() > max_entries) return wrong("tasks");
    std::map<std::string, size_t> index_of;
    for (const Json& item : looks) {
        const std::string where = fmt::format("looks[{}]", plan.looks.size());
        Result<PlanLook> look = read_look(item, plan, where);
        if (!look) return look.error();
        if (!index_of.emplace(look->name, plan.looks.size()).second) return wrong(where + ".name", "another look has this name");
        plan.looks.push_back(*std::move(look));
    }
    for (const Json& item : tasks) {
        const Result<PlanTask> task = read_task(item, plan.looks, index_of, fmt::format("tasks[{}]", plan.tasks.size()));
        if (!task) return task.error();
        plan.tasks.push_back(*task);
    }
    return {};
}

Result<void> read_costs(const Json& json, MeasuredCosts& costs) {
    const std::pair<const char*, double*> fields[] = {{"start", &costs.start},           {"sample", &costs.sample},
                                                      {"write", &costs.write},           {"read", &costs.read},
                                                      {"memory_mib", &costs.memory_mib}, {"part_mib", &costs.part_mib}};
    for (const auto& [key, value] : fields)
        if (!json.is_object() || !read_json(member_of(json, key), *value) || *value < 0) return wrong(fmt::format("measured.{}", key));
    return {};
}

Result<void> read_numbers(const Json& json, RenderPlan& plan) {
    if (!read_json(member_of(json, "layers"), plan.layers)) return wrong("layers");
    if (const Result<Layers> layers = parse_layers(plan.layers); !layers || !layers->film)
        return wrong("layers", "not a list of layers with film");
    if (const Json& mib = member_of(json, "texture_memory"); !mib.is_null()) {
        int64_t number = 0;
        if (!read_json(mib, number) || number < 1 || number > (int64_t(1) << 30)) return wrong("texture_memory");
        plan.texture_mib = number;
    }
    const auto in_range = [](int64_t n) { return n >= 1 && n <= max_samples; };
    if (!read_json(member_of(json, "chunk"), plan.chunk) || !in_range(plan.chunk)) return wrong("chunk");
    if (!read_json(member_of(json, "spp"), plan.spp) || !in_range(plan.spp)) return wrong("spp");
    if (const Json& error = member_of(json, "error"); !error.is_null())
        if (!read_json(error, plan.error) || !(plan.error > 0)) return wrong("error");
    if (!read_json(member_of(json, "adaptive"), plan.adaptive)) return wrong("adaptive");
    if (!read_json(member_of(json, "fps"), plan.frames_per_second) || !(plan.frames_per_second >= 0.01 && plan.frames_per_second <= 1000))
        return wrong("fps");
    if (!read_json(member_of(json, "program"), plan.program)) return wrong("program");
    return read_costs(member_of(json, "measured"), plan.costs);
}

Result<RenderPlan> plan_in(const Json& json) {
    RenderPlan plan;
    int format = 0;
    if (!read_json(member_of(json, "format"), format) || format != 1) return wrong("format", "not a plan that this program can read");
    if (!read_json(member_of(json, "version"), plan.version)) return wrong("version");
    if (plan.version != BLUSH_VERSION)
        return Error{.what = fmt::format("was made by blush {}, but this is blush {}: all machines need the same version", plan.version,
                                         BLUSH_VERSION)};
    if (const Result<void> read = read_numbers(json, plan); !read) return read.error();
    const Json& view = member_of(json, "view");
    const Result<ParsedSettings<ViewSettings>> parsed = view.is_object() ? parse_view_settings(json_text(view)) : wrong("view");
    if (!parsed) return in_file(parsed.error(), "view");
    plan.view = parsed->settings;
    if (const Result<void> read = read_scenes(json, plan); !read) return read.error();
    if (const Result<void> read = read_looks_and_tasks(json, plan); !read) return read.error();
    return plan;
}

// ---- writing

OrderedJson look_json(const PlanLook& look) {
    const auto or_null = [](const std::string& text) { return text.empty() ? OrderedJson() : OrderedJson(text); };
    OrderedJson words = OrderedJson::object();
    for (const auto& [name, value] : look.words) words[name] = value;
    return {{"name", look.name},
            {"scene", look.scene},
            {"set", words},
            {"sequence", or_null(look.sequence)},
            {"finished", look.finished},
            {"lights_hash", look.lights_hash},
            {"allocation", or_null(look.allocation)},
            {"settings", parsed_text(render_settings_json(look.settings))},
            {"edits", look.edits.empty() ? OrderedJson() : parsed_text(look.edits)}};
}

OrderedJson scaling_json(const RenderPlan& plan) {
    OrderedJson rows = OrderedJson::array();
    const std::vector<Scaling> table = scaling_table(plan.costs, {int64_t(plan.looks.size()), plan.spp, plan.chunk});
    for (const Scaling& row : table)
        rows.push_back({{"workers", row.workers}, {"seconds", row.seconds}, {"speedup", row.speedup}, {"efficiency", row.efficiency}});
    return {{"knee", knee_of(table)}, {"table", rows}};
}

} // namespace

std::string PlanLook::recipe(const std::string& scene_hash, const std::string& layers) const {
    uint64_t hash = 0xcbf29ce484222325u; // FNV-1a
    const std::string sized = render_settings_json(settings);
    for (const std::string* text : {&scene_hash, &layers, &edits, &lights_hash, &sized}) {
        for (const char c : *text) hash = (hash ^ uint8_t(c)) * 0x100000001b3u;
        hash = (hash ^ 0xffu) * 0x100000001b3u; // a byte that no text holds: where one ends
    }
    return fmt::format("{:016x}", hash);
}

int64_t end_of_task(const PlanLook& look, int64_t first, int64_t last) {
    constexpr int64_t pilot = SampleAllocation::pilot_samples;
    return look.settings.adaptive && first < pilot ? std::min(last, first < pilot / 2 ? pilot / 2 : pilot) : last;
}

std::string lights_hash(const Scene& scene) {
    Scene lights;
    lights.environment = scene.environment;
    lights.lights = scene.lights;
    return scene_hash(lights);
}

bool is_safe_name(const std::string& name) {
    constexpr size_t longest = 200; // file systems allow 255 bytes with the ending
    const auto good = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    };
    return !name.empty() && name.size() <= longest && name.front() != '.' && name.front() != '-' && std::ranges::all_of(name, good);
}

Result<RenderPlan> read_plan(const std::filesystem::path& folder) {
    const std::string file = (folder / "plan.json").string();
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_plan_bytes);
    if (!bytes) return bytes.error();
    const Result<Json> json = parse_json_object(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
    if (!json) return in_file(json.error(), file);
    Result<RenderPlan> plan = plan_in(*json);
    if (!plan) return in_file(plan.error(), file);
    return plan;
}

Result<void> write_plan(const std::filesystem::path& folder, const RenderPlan& plan) {
    const auto if_set = [](bool set, const auto& value) { return set ? OrderedJson(value) : OrderedJson(); };
    const MeasuredCosts& c = plan.costs;
    OrderedJson json{{"format", 1},
                     {"about", about},
                     {"version", plan.version},
                     {"program", plan.program},
                     {"layers", plan.layers},
                     {"texture_memory", if_set(plan.texture_mib.has_value(), plan.texture_mib.value_or(0))},
                     {"adaptive", plan.adaptive},
                     {"chunk", plan.chunk},
                     {"spp", plan.spp},
                     {"error", if_set(plan.error > 0, plan.error)},
                     {"fps", plan.frames_per_second},
                     {"view", parsed_text(view_settings_json(plan.view))},
                     {"measured",
                      {{"start", c.start},
                       {"sample", c.sample},
                       {"write", c.write},
                       {"read", c.read},
                       {"memory_mib", c.memory_mib},
                       {"part_mib", c.part_mib}}},
                     {"scaling", scaling_json(plan)}};
    json["scenes"] = OrderedJson::array();
    for (const PlanScene& scene : plan.scenes) json["scenes"].push_back({{"file", scene.file}, {"hash", scene.hash}});
    json["looks"] = OrderedJson::array();
    for (const PlanLook& look : plan.looks) json["looks"].push_back(look_json(look));
    json["tasks"] = OrderedJson::array();
    for (size_t i = 0; i < plan.tasks.size(); ++i)
        json["tasks"].push_back({{"task", i + 1},
                                 {"look", plan.looks[plan.tasks[i].look].name},
                                 {"samples", {plan.tasks[i].samples.first, plan.tasks[i].samples.last}}});
    return write_json((folder / "plan.json").string(), json);
}

} // namespace blush
