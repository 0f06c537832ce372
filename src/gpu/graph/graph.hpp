// SPDX-License-Identifier: MIT
#pragma once

// The frame graph: passes say what they read and write; order, culling, memory reuse and barriers follow.
//
// A technique is a function from handles to handles. Writing to a handle gives a new version of it; the old
// one may still be read by passes declared before the write, and is an error afterwards. Nothing here touches
// a device: building and compiling run (and are tested) without one; src/gpu/graph/execute.hpp records the
// result.
//
//     auto pass = graph.compute("hatch", shaders::hatch_comp);
//     pass.sample(in.light).sample(in.coordinates);
//     const ImageId ink = pass.write(graph.image("hatch/ink", {.width = w, .height = h}));
//     pass.push(HatchParams{...}).dispatch_over(w, h);
//     return ink;

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace estampe::gpu {

class Image;    // a device image owned outside the graph
class Buffer;   // a device buffer owned outside the graph
class Recorder; // what a custom pass records into

/// The name of a pass or a resource while it is put together: frames are declared anew all the time, and
/// should not ask the heap for that. Cut off after 119 characters.
class Name {
public:
    Name(std::string_view text) { *this += text; } // NOLINT(google-explicit-constructor): names are texts

    Name(const char* text) : Name(std::string_view(text)) {} // NOLINT(google-explicit-constructor)

    Name(const std::string& text) : Name(std::string_view(text)) {} // NOLINT(google-explicit-constructor)

    Name& operator+=(std::string_view more)
    {
        const size_t added = std::min(more.size(), text_.size() - size_);
        std::copy_n(more.data(), added, text_.data() + size_);
        size_ += added;
        return *this;
    }

    [[nodiscard]] friend Name operator+(Name name, std::string_view more) { return name += more; }

    [[nodiscard]] std::string_view view() const { return {text_.data(), size_}; }

    operator std::string_view() const { return view(); } // NOLINT(google-explicit-constructor)

private:
    std::array<char, 119> text_;
    size_t size_ = 0;
};

/// What a custom pass records: a callable of one Recorder&, or nothing. As std::function, but what it holds
/// on to stands within it, up to 256 bytes, and not on the heap.
class Recording {
public:
    Recording() = default;

    template <class Callable>

    requires(!std::is_same_v<std::remove_cvref_t<Callable>, Recording>)
        Recording(Callable&& callable) // NOLINT: implicit, and of no recordings
    {
        using Held = std::remove_cvref_t<Callable>;
        static_assert(sizeof(Held) <= room_bytes && alignof(Held) <= alignof(std::max_align_t));
        new (room_.data()) Held(std::forward<Callable>(callable));
        acts_ = &acts_of<Held>;
    }

    Recording(const Recording& other) : acts_(other.acts_)
    {
        if (acts_ != nullptr) {
            acts_->copy(other.room_.data(), room_.data());
        }
    }

    Recording& operator=(const Recording& other)
    {
        if (this != &other) {
            clear();
            if (other.acts_ != nullptr) {
                other.acts_->copy(other.room_.data(), room_.data());
            }
            acts_ = other.acts_;
        }
        return *this;
    }

    ~Recording() { clear(); }

    void clear()
    {
        if (acts_ != nullptr) {
            acts_->destroy(room_.data());
            acts_ = nullptr;
        }
    }

    explicit operator bool() const { return acts_ != nullptr; }

    void operator()(Recorder& recorder) const { acts_->call(room_.data(), recorder); }

private:
    static constexpr size_t room_bytes = 256;

    struct Acts {
        void (*call)(const std::byte* held, Recorder& recorder);
        void (*copy)(const std::byte* held, std::byte* to);
        void (*destroy)(std::byte* held);
    };

    template <class Held>
    static constexpr Acts acts_of{
        [](const std::byte* held, Recorder& recorder) {
            (*std::launder(reinterpret_cast<const Held*>(held)))(recorder);
        },
        [](const std::byte* held, std::byte* to) {
            new (to) Held(*std::launder(reinterpret_cast<const Held*>(held)));
        },
        [](std::byte* held) { std::destroy_at(std::launder(reinterpret_cast<Held*>(held))); }};

    alignas(std::max_align_t) std::array<std::byte, room_bytes> room_;
    const Acts* acts_ = nullptr;
};

enum class Format : uint8_t {
    r32ui,
    rg32ui,
    rgba32ui,
    rgba8,
    r8,
    r16f,
    rg16f,
    rgba16f,
    r32f,
    rgba32f,
    rgba8_srgb,
    depth32f
};

struct ImageDesc {
    uint32_t width = 0;
    uint32_t height = 0;
    Format format = Format::rgba8;
    uint32_t layers = 1;
    uint32_t mips = 1;
    bool operator==(const ImageDesc&) const = default;
};

struct BufferDesc {
    uint64_t size_bytes = 0;
    bool operator==(const BufferDesc&) const = default;
};

/// One version of an image of one graph. There is no "none": it has no default, so that a forgotten input
/// does not compile.
struct ImageId {
    constexpr ImageId(uint32_t resource_index, uint32_t version_number)
        : resource(resource_index), version(version_number)
    {
    }

    uint32_t resource;
    uint32_t version;
    bool operator==(const ImageId&) const = default;
};

/// One version of a buffer of one graph. It has no default either.
struct BufferId {
    constexpr BufferId(uint32_t resource_index, uint32_t version_number)
        : resource(resource_index), version(version_number)
    {
    }

    uint32_t resource;
    uint32_t version;
    bool operator==(const BufferId&) const = default;
};

/// How a pass touches a resource: decides stage, access mask and image layout.
enum class Access : uint8_t {
    compute_sampled,        ///< texelFetch or a sampler
    compute_storage_read,   ///< storage image or buffer, read
    compute_storage_write,  ///< storage image or buffer, every texel or byte that matters is written
    compute_storage_modify, ///< read and written, atomics
    compute_uniform,        ///< uniform buffer
    raster_sampled,         ///< as compute_sampled, by the vertex or the fragment stage
    raster_storage_read,    ///< as compute_storage_read, by the vertex or the fragment stage
    raster_uniform,         ///< as compute_uniform, by the vertex or the fragment stage
    indirect,               ///< arguments of a dispatch or a draw
    transfer_read,
    transfer_write,
    color_attachment,        ///< cleared, then drawn into
    color_attachment_modify, ///< drawn over
    depth_attachment,        ///< tested and written; cleared first when nothing was there
    host_read,               ///< read back after the frame
};

[[nodiscard]] constexpr bool is_write(Access access)
{
    return access == Access::compute_storage_write || access == Access::compute_storage_modify ||
           access == Access::transfer_write || access == Access::color_attachment ||
           access == Access::color_attachment_modify || access == Access::depth_attachment;
}

/// Whether what was there before matters: false for a plain overwrite.
[[nodiscard]] constexpr bool is_read(Access access)
{
    return access != Access::compute_storage_write && access != Access::transfer_write &&
           access != Access::color_attachment;
}

[[nodiscard]] constexpr bool is_sampled(Access access)
{
    return access == Access::compute_sampled || access == Access::raster_sampled;
}

[[nodiscard]] constexpr bool is_uniform(Access access)
{
    return access == Access::compute_uniform || access == Access::raster_uniform;
}

enum class Layout : uint8_t {
    undefined,
    general,
    shader_read,
    transfer_source,
    transfer_target,
    color,
    depth
};

/// A compiled shader: SPIR-V words embedded in the program.
struct Shader {
    const char* name;
    std::span<const uint32_t> spirv;
};

/// Filtering of a sampled image.
enum class Sampling : uint8_t { nearest, linear, linear_repeat };

struct Use {
    uint32_t resource = 0;
    uint32_t version = 0; ///< read version; for a write, the version before
    Access access = Access::compute_sampled;
    Sampling sampling = Sampling::nearest;
    Format texel = Format::rgba32ui; ///< of a sampled buffer
    bool bound = true; ///< takes the next binding number of the pass (indirect arguments do not)
};

struct Dispatch {
    uint32_t groups_x = 0, groups_y = 0, groups_z = 0;
    uint32_t indirect_resource = UINT32_MAX; ///< when set, the groups come from this buffer
    uint64_t indirect_offset_bytes = 0;
};

/// How a raster pass draws.
struct Draw {
    const Shader* vertex = nullptr;
    const Shader* fragment = nullptr; ///< null when depth is all that is wanted
    uint32_t vertex_count = 0;
    uint32_t indirect_resource = UINT32_MAX; ///< when set, the counts come from this buffer
    bool cull_back_faces = false;
};

struct PassRecord {
    std::string name;
    const Shader* shader = nullptr; ///< compute passes only
    Draw draw = {};                 ///< raster passes only
    std::vector<Use> uses = {};
    std::vector<std::byte> push = {};
    uint32_t variant = 0; ///< the shaders' specialization constant 0
    Dispatch dispatch = {};
    uint32_t estimated_duration_us = 0; ///< about, as Pass::estimated_duration_us() told; 0: not told
    Recording record = {};              ///< custom passes only
    bool has_side_effect = false;       ///< never culled

    [[nodiscard]] bool is_raster() const { return draw.vertex != nullptr; }
};

struct ResourceRecord {
    std::string name;
    bool is_image = false;
    ImageDesc image = {};
    BufferDesc buffer = {};
    Image* imported_image = nullptr;
    Buffer* imported_buffer = nullptr;
    Layout initial_layout = Layout::undefined; ///< imported images: the layout they come in
    bool exported = false;                     ///< its content is wanted after the frame
    uint32_t newest_version = 0;

    [[nodiscard]] bool is_imported() const { return imported_image != nullptr || imported_buffer != nullptr; }
};

class Graph;

/// Declares one pass. Bindings are numbered 0, 1, 2, ... in the order of the calls that bind.
class Pass {
public:
    Pass& sample(ImageId image, Sampling sampling = Sampling::nearest);
    /// A buffer as texels, four unsigned words unless said (usamplerBuffer, samplerBuffer): processors gather
    /// those for several threads at once, storage buffers word by word.
    Pass& sample(BufferId buffer, Format texel = Format::rgba32ui);
    Pass& read(ImageId image);
    Pass& read(BufferId buffer);
    Pass& uniform(BufferId buffer);
    [[nodiscard]] ImageId write(ImageId image);
    [[nodiscard]] BufferId write(BufferId buffer);
    [[nodiscard]] ImageId modify(ImageId image);
    [[nodiscard]] BufferId modify(BufferId buffer);

    /// Raster passes: draws into `image`, at the fragment shader's next output. The first pass that draws
    /// into an image of the graph clears it to zeros; the passes after it, and all that draw into an imported
    /// image, draw over what is there.
    [[nodiscard]] ImageId color(ImageId image);
    /// Raster passes: keeps what is nearest, in reversed depth; of two equal depths, the later. Cleared as
    /// by color(), to the farthest.
    [[nodiscard]] ImageId depth(ImageId image);
    /// Raster passes: draws no triangle whose corners run clockwise on the page.
    Pass& cull_back_faces();

    /// For custom passes: an access that takes no binding. `touch` is for reads, `touch_write` for writes;
    /// the wrong kind, or one that the resource cannot have, throws std::logic_error. So does a handle of
    /// another graph, anywhere.
    Pass& touch(ImageId image, Access access);
    Pass& touch(BufferId buffer, Access access);
    [[nodiscard]] ImageId touch_write(ImageId image, Access access);
    [[nodiscard]] BufferId touch_write(BufferId buffer, Access access);

    /// Constants of this dispatch: any trivially copyable struct of at most 128 bytes.
    template <class T>

    requires(std::is_trivially_copyable_v<T> && sizeof(T) <= 128) Pass& push(const T& constants)
    {
        return push_bytes(std::as_bytes(std::span<const T, 1>(&constants, 1)));
    }

    /// Sets specialization constant 0 of the shader, or of both: bits that say what this scene needs of it,
    /// so that the rest of the code is left out. Each value makes a pipeline of its own.
    Pass& variant(uint32_t bits);

    /// About how long the pass takes on a large GPU, if it leaves that idle meanwhile: few groups that work
    /// long, or threads that wait for one thing after another. Such passes then run beside each other.
    Pass& estimated_duration_us(uint32_t us);

    /// One thread a pixel, in groups of 8 x 8 as the shaders declare.
    void dispatch_over(uint32_t width, uint32_t height, uint32_t layers = 1);
    /// The same in groups of 8 x 32: a GPU takes long to start as many as a page has of 8 x 8.
    void dispatch_over_page(uint32_t width, uint32_t height, uint32_t layers = 1);
    /// One thread an item, in groups of 64; shaders number items by item_index() of shaders/loops.glsl.
    void dispatch_items(uint32_t count);
    void dispatch(uint32_t groups_x, uint32_t groups_y = 1, uint32_t groups_z = 1);
    void dispatch_indirect(BufferId arguments, uint64_t offset_bytes = 0);
    /// Raster passes: one triangle for every three vertices. The vertex shader finds them by gl_VertexIndex.
    void draw(uint32_t vertex_count);
    /// The same with counts of vertices and instances from a buffer that holds a VkDrawIndirectCommand.
    void draw_indirect(BufferId arguments);
    /// Custom passes: `record` is called when the pass is executed.
    void execute(const Recording& record);
    /// Keeps the pass even if nobody reads what it writes.
    Pass& keep();

private:
    friend class Graph;

    Pass(Graph& graph, uint32_t index) : graph_(graph), index_(index) {}

    Pass& push_bytes(std::span<const std::byte> bytes);
    PassRecord& record();
    uint32_t use(uint32_t resource, uint32_t version, bool is_image,
                 Use how); ///< returns the version afterwards

    Graph& graph_;
    uint32_t index_;
};

class Graph {
public:
    /// Transient: lives from its first write to its last read, and shares memory with others outside that
    /// time.
    [[nodiscard]] ImageId image(std::string_view name, const ImageDesc& desc);
    [[nodiscard]] BufferId buffer(std::string_view name, const BufferDesc& desc);

    /// Whoever imports the same image or buffer again gets the same handle, of the name it had first. Throws
    /// std::logic_error when the two descriptions differ, or when a pass has written it: what was written is
    /// known by the handle that the pass gave.
    [[nodiscard]] ImageId import_image(std::string_view name, Image& image, const ImageDesc& desc,
                                       Layout initial_layout);
    [[nodiscard]] BufferId import_buffer(std::string_view name, Buffer& buffer, const BufferDesc& desc);

    /// Marks the content as wanted after the frame: what makes it is not culled, and its memory is not
    /// reused. Throws std::logic_error when the handle has been overwritten.
    void export_image(ImageId image);
    void export_buffer(BufferId buffer);

    [[nodiscard]] Pass compute(std::string_view name, const Shader& shader);
    /// A pass that draws triangles by the device's own rasteriser. It may sample, read and take uniforms;
    /// it writes attachments only.
    [[nodiscard]] Pass raster(std::string_view name, const Shader& vertex, const Shader& fragment);
    /// The same without a fragment shader: only depth is drawn.
    [[nodiscard]] Pass raster(std::string_view name, const Shader& vertex);
    [[nodiscard]] Pass custom(std::string_view name);

    [[nodiscard]] const ImageDesc& describe(ImageId image) const;
    [[nodiscard]] const BufferDesc& describe(BufferId buffer) const;

    /// Forgets all passes and resources, but not the room that they took: what is declared next needs none.
    void clear();

    [[nodiscard]] std::span<const PassRecord> passes() const { return {passes_.data(), pass_count_}; }

    [[nodiscard]] std::span<const ResourceRecord> resources() const
    {
        return {resources_.data(), resource_count_};
    }

private:
    friend class Pass;
    [[nodiscard]] const ResourceRecord& checked(uint32_t resource, bool is_image,
                                                std::string_view user) const;
    void mark_exported(uint32_t resource, uint32_t version, bool is_image);
    [[nodiscard]] PassRecord& new_pass(std::string_view name);
    [[nodiscard]] ResourceRecord& new_resource(std::string_view name);

    [[nodiscard]] Pass last_pass() { return {*this, pass_count_ - 1}; }

    /// Returns its index.
    uint32_t take_in(std::string_view name, const ResourceRecord& imported);

    std::vector<PassRecord> passes_; ///< the rest is room for more
    std::vector<ResourceRecord> resources_;
    uint32_t pass_count_ = 0;
    uint32_t resource_count_ = 0;
};

} // namespace estampe::gpu
