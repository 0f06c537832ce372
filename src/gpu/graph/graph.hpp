// SPDX-License-Identifier: MIT
#pragma once

// The frame graph. Each pass declares which resources it reads and writes. From the declared reads and
// writes, the graph derives the order of passes, culling, memory reuse and barriers.
//
// A technique is a function that takes resource handles and returns resource handles. A write returns a
// handle to a new version of the resource. Passes declared before the write may still read the old version;
// later passes that read the old version cause an error. Building, compiling and testing a graph needs no
// device; src/gpu/graph/execute.hpp records the compiled graph.
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

class Image;    // A device image owned outside the graph
class Buffer;   // A device buffer owned outside the graph
class Recorder; // Gives a custom pass its command buffer and resources

/// Name of a pass or resource, in inline storage, because graphs are declared every frame and must not
/// allocate. Longer names are truncated to 119 characters.
class Name {
public:
    Name(std::string_view text) { *this += text; } // NOLINT(google-explicit-constructor): a text is a name

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

/// Callable that records the commands of a custom pass; it takes a Recorder&, and may be empty. Like
/// std::function, but stores captures of up to 256 bytes inline instead of on the heap.
class Recording {
public:
    Recording() = default;

    template <class Callable>

    requires(!std::is_same_v<std::remove_cvref_t<Callable>, Recording>)
        Recording(Callable&& callable) // NOLINT: implicit by intent; never a copy
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

/// Handle to one version of an image in one graph. The handle has no default constructor and no null value,
/// so code that forgets an input does not compile.
struct ImageId {
    constexpr ImageId(uint32_t resource_index, uint32_t version_number)
        : resource(resource_index), version(version_number)
    {
    }

    uint32_t resource;
    uint32_t version;
    bool operator==(const ImageId&) const = default;
};

/// Handle to one version of a buffer in one graph. The handle has no default constructor and no null value.
struct BufferId {
    constexpr BufferId(uint32_t resource_index, uint32_t version_number)
        : resource(resource_index), version(version_number)
    {
    }

    uint32_t resource;
    uint32_t version;
    bool operator==(const BufferId&) const = default;
};

/// How a pass accesses a resource. Determines the pipeline stage, the access mask and the image layout.
enum class Access : uint8_t {
    compute_sampled,        ///< A compute shader samples the resource, or fetches its texels
    compute_storage_read,   ///< A compute shader reads a storage image or buffer
    compute_storage_write,  ///< A compute shader writes all content that is used later
    compute_storage_modify, ///< A compute shader reads and writes the content, or uses atomics
    compute_uniform,        ///< A compute shader reads a uniform buffer
    raster_sampled,         ///< Like compute_sampled, but in the vertex or fragment stage
    raster_storage_read,    ///< Like compute_storage_read, but in the vertex or fragment stage
    raster_uniform,         ///< Like compute_uniform, but in the vertex or fragment stage
    indirect,               ///< The device reads arguments of a dispatch or draw call
    transfer_read,
    transfer_write,
    color_attachment,        ///< The image is cleared, then drawn into
    color_attachment_modify, ///< Draws over the existing content
    depth_attachment,        ///< Depth is tested and written; an image without content is cleared first
    host_read,               ///< The host reads the content after the frame
};

[[nodiscard]] constexpr bool is_write(Access access)
{
    return access == Access::compute_storage_write || access == Access::compute_storage_modify ||
           access == Access::transfer_write || access == Access::color_attachment ||
           access == Access::color_attachment_modify || access == Access::depth_attachment;
}

/// Whether the access depends on the earlier content of the resource; false if the access overwrites all of
/// it.
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
    uint32_t version = 0; ///< Version of the resource that is read; for a write, the version before the write
    Access access = Access::compute_sampled;
    Sampling sampling = Sampling::nearest;
    Format texel = Format::rgba32ui; ///< Format of the texels; only for sampled buffers
    bool bound = true; ///< The resource takes the next binding number; false for indirect arguments
};

struct Dispatch {
    uint32_t groups_x = 0, groups_y = 0, groups_z = 0;
    uint32_t indirect_resource = UINT32_MAX; ///< If set, the buffer that holds the workgroup counts
    uint64_t indirect_offset_bytes = 0;
};

/// Draw call of a raster pass.
struct Draw {
    const Shader* vertex = nullptr;
    const Shader* fragment = nullptr; ///< Null: the pass draws only depth
    uint32_t vertex_count = 0;
    uint32_t indirect_resource = UINT32_MAX; ///< If set, the buffer that holds the draw counts
    bool cull_back_faces = false;
};

struct PassRecord {
    std::string name;
    const Shader* shader = nullptr; ///< Used only by compute passes
    Draw draw = {};                 ///< Used only by raster passes
    std::vector<Use> uses = {};
    std::vector<std::byte> push = {};
    uint32_t variant = 0; ///< Value of the shaders' specialization constant 0
    Dispatch dispatch = {};
    /// Duration that the caller estimated in microseconds, see Pass::estimated_duration_us(); 0: unknown.
    uint32_t estimated_duration_us = 0;
    Recording record = {};        ///< Used only by custom passes
    bool has_side_effect = false; ///< The pass is never culled

    [[nodiscard]] bool is_raster() const { return draw.vertex != nullptr; }
};

struct ResourceRecord {
    std::string name;
    bool is_image = false;
    ImageDesc image = {};
    BufferDesc buffer = {};
    Image* imported_image = nullptr;
    Buffer* imported_buffer = nullptr;
    Layout initial_layout = Layout::undefined; ///< Layout of an imported image before the frame
    bool exported = false;                     ///< The content is needed after the frame
    uint32_t newest_version = 0;

    [[nodiscard]] bool is_imported() const { return imported_image != nullptr || imported_buffer != nullptr; }
};

class Graph;

/// Declares one pass. Bindings are numbered 0, 1, 2, ... in the order of the binding calls.
class Pass {
public:
    Pass& sample(ImageId image, Sampling sampling = Sampling::nearest);
    /// Binds a buffer as texels (usamplerBuffer, samplerBuffer), by default of four unsigned words. CPU
    /// drivers gather texels for several threads at once, but read storage buffers word by word.
    Pass& sample(BufferId buffer, Format texel = Format::rgba32ui);
    Pass& read(ImageId image);
    Pass& read(BufferId buffer);
    Pass& uniform(BufferId buffer);
    [[nodiscard]] ImageId write(ImageId image);
    [[nodiscard]] BufferId write(BufferId buffer);
    [[nodiscard]] ImageId modify(ImageId image);
    [[nodiscard]] BufferId modify(BufferId buffer);

    /// Raster passes: draws into `image` as the fragment shader's next output. The first pass that draws
    /// into an image of the graph clears it to zeros. Later passes, and all passes on imported images, keep
    /// the content.
    [[nodiscard]] ImageId color(ImageId image);
    /// Raster passes: enables the depth test with reversed depth. Of two fragments at equal depth, the later
    /// fragment is kept. The first pass that draws into an image of the graph clears it to the farthest
    /// depth.
    [[nodiscard]] ImageId depth(ImageId image);
    /// Raster passes: culls triangles whose corners are in clockwise order on the page.
    Pass& cull_back_faces();

    /// Custom passes: declares an access without a binding. `touch` declares reads, `touch_write` declares
    /// writes. The functions `touch` and `touch_write` throw std::logic_error for the wrong kind of access
    /// and for an access that the resource does not allow. Like all functions of the graph, `touch` and
    /// `touch_write` throw std::logic_error for a handle of another graph.
    Pass& touch(ImageId image, Access access);
    Pass& touch(BufferId buffer, Access access);
    [[nodiscard]] ImageId touch_write(ImageId image, Access access);
    [[nodiscard]] BufferId touch_write(BufferId buffer, Access access);

    /// Sets the push constants of the pass: any trivially copyable struct of at most 128 bytes.
    template <class T>

    requires(std::is_trivially_copyable_v<T> && sizeof(T) <= 128) Pass& push(const T& constants)
    {
        return push_bytes(std::as_bytes(std::span<const T, 1>(&constants, 1)));
    }

    /// Sets specialization constant 0 of the pass's shaders. The bits of the constant select the shader parts
    /// that a scene uses; the driver removes all other parts. For each value a separate pipeline is compiled.
    Pass& variant(uint32_t bits);

    /// Sets the approximate duration, on a large GPU, of a pass that leaves most of the GPU idle. Such a pass
    /// has few workgroups that run long, or threads with long dependency chains. A pass with an estimated
    /// duration is scheduled in parallel with other passes.
    Pass& estimated_duration_us(uint32_t us);

    /// Dispatches one thread per pixel, in workgroups of 8 x 8 threads. The shader must declare this
    /// workgroup size.
    void dispatch_over(uint32_t width, uint32_t height, uint32_t layers = 1);
    /// Dispatches one thread per pixel, in workgroups of 8 x 32 threads. A GPU needs much longer to start
    /// workgroups of 8 x 8 threads for a whole page.
    void dispatch_over_page(uint32_t width, uint32_t height, uint32_t layers = 1);
    /// Dispatches one thread per item, in workgroups of 64 threads. Shaders get the index of the item from
    /// item_index() in shaders/loops.glsl.
    void dispatch_items(uint32_t count);
    void dispatch(uint32_t groups_x, uint32_t groups_y = 1, uint32_t groups_z = 1);
    void dispatch_indirect(BufferId arguments, uint64_t offset_bytes = 0);
    /// Raster passes: draws one triangle per three vertices. The vertex shader loads vertices by
    /// gl_VertexIndex.
    void draw(uint32_t vertex_count);
    /// Raster passes: draws with the vertex and instance counts in `arguments`, a buffer that holds a
    /// VkDrawIndirectCommand.
    void draw_indirect(BufferId arguments);
    /// Custom passes: sets the function that is called when the pass is executed.
    void execute(const Recording& record);
    /// Keeps the pass even if no pass reads its results.
    Pass& keep();

private:
    friend class Graph;

    Pass(Graph& graph, uint32_t index) : graph_(graph), index_(index) {}

    Pass& push_bytes(std::span<const std::byte> bytes);
    PassRecord& record();
    uint32_t use(uint32_t resource, uint32_t version, bool is_image,
                 Use how); ///< Returns the resource's version after the use

    Graph& graph_;
    uint32_t index_;
};

class Graph {
public:
    /// Declares a transient resource. A transient resource exists from its first write to its last read;
    /// outside that time its memory may hold other resources. The description is passed by value: it may
    /// belong to another resource of this graph, which moves in memory when a resource is added.
    [[nodiscard]] ImageId image(std::string_view name, ImageDesc desc);
    [[nodiscard]] BufferId buffer(std::string_view name, BufferDesc desc);

    /// Declares an image or buffer that exists outside the graph. A second import of the same image or buffer
    /// returns the first handle, with the first name. The second import throws std::logic_error if the
    /// descriptions differ, or if a pass has already written the resource. If a pass has already written the
    /// resource, use the handle that the pass returned.
    [[nodiscard]] ImageId import_image(std::string_view name, Image& image, const ImageDesc& desc,
                                       Layout initial_layout);
    [[nodiscard]] BufferId import_buffer(std::string_view name, Buffer& buffer, const BufferDesc& desc);

    /// Marks the content of the resource as needed after the frame. The pass that writes the content is then
    /// not culled, and the memory is not reused. Throws std::logic_error if a pass has already overwritten
    /// this version.
    void export_image(ImageId image);
    void export_buffer(BufferId buffer);

    [[nodiscard]] Pass compute(std::string_view name, const Shader& shader);
    /// Adds a pass that draws triangles with the device's rasteriser. The pass may sample images and read
    /// buffers and uniforms, but writes only attachments.
    [[nodiscard]] Pass raster(std::string_view name, const Shader& vertex, const Shader& fragment);
    /// Adds a raster pass without a fragment shader, which draws only depth.
    [[nodiscard]] Pass raster(std::string_view name, const Shader& vertex);
    [[nodiscard]] Pass custom(std::string_view name);

    [[nodiscard]] const ImageDesc& describe(ImageId image) const;
    [[nodiscard]] const BufferDesc& describe(BufferId buffer) const;

    /// Removes all passes and resources but keeps their host memory, so that later declarations do not
    /// allocate.
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

    /// Adds an imported resource and returns its index.
    uint32_t take_in(std::string_view name, const ResourceRecord& imported);

    /// Entries from index `pass_count_` on are unused; their memory is kept for later passes.
    std::vector<PassRecord> passes_;
    std::vector<ResourceRecord> resources_;
    uint32_t pass_count_ = 0;
    uint32_t resource_count_ = 0;
};

} // namespace estampe::gpu
