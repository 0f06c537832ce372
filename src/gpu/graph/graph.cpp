// SPDX-License-Identifier: MIT
#include "gpu/graph/graph.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "gpu/graph/compile.hpp"

namespace estampe::gpu {

namespace {

constexpr uint32_t group_size_px = 8;

uint32_t groups_over(uint32_t pixels)
{
    return pixels / group_size_px + (pixels % group_size_px != 0 ? 1 : 0);
}

bool suits(Access access, bool is_image)
{
    switch (access) {
    case Access::color_attachment:
    case Access::color_attachment_modify:
    case Access::depth_attachment:
        return is_image;
    case Access::compute_uniform:
    case Access::raster_uniform:
    case Access::indirect:
    case Access::host_read:
        return !is_image;
    case Access::compute_sampled:
    case Access::compute_storage_read:
    case Access::compute_storage_write:
    case Access::compute_storage_modify:
    case Access::raster_sampled:
    case Access::raster_storage_read:
    case Access::transfer_read:
    case Access::transfer_write:
        return true;
    }
    return false;
}

void require_kind(const PassRecord& pass, Access access, bool wants_write)
{
    if (is_write(access) != wants_write)
        throw std::logic_error(fmt::format("pass '{}': {} is a {}: use {}", pass.name, name_of(access),
                                           is_write(access) ? "write" : "read",
                                           is_write(access) ? "touch_write" : "touch"));
}

/// Returns the access for the pass's own kind: `by_compute` for compute passes, `by_raster` for raster
/// passes.
Access read_by(const PassRecord& pass, Access by_compute, Access by_raster)
{
    return pass.is_raster() ? by_raster : by_compute;
}

void require_raster(const PassRecord& pass, const char* what)
{
    if (!pass.is_raster())
        throw std::logic_error(fmt::format("pass '{}': {} is for raster passes", pass.name, what));
}

void require_format(const PassRecord& pass, const Graph& graph, ImageId image, bool wants_depth)
{
    if ((graph.describe(image).format == Format::depth32f) != wants_depth)
        throw std::logic_error(fmt::format("pass '{}': '{}' is no {} image", pass.name,
                                           graph.resources()[image.resource].name,
                                           wants_depth ? "depth" : "colour"));
}

} // namespace

PassRecord& Pass::record()
{
    return graph_.passes_[index_];
}

uint32_t Pass::use(uint32_t resource, uint32_t version, bool is_image, Use how)
{
    const ResourceRecord& used = graph_.checked(resource, is_image, record().name);
    if (!suits(how.access, is_image))
        throw std::logic_error(fmt::format("pass '{}': '{}' is {}, which has no access {}", record().name,
                                           used.name, is_image ? "an image" : "a buffer",
                                           name_of(how.access)));
    if (record().is_raster() && is_write(how.access) && how.bound)
        throw std::logic_error(
            fmt::format("pass '{}': a raster pass writes attachments only: use color or depth for '{}'",
                        record().name, used.name));
    how.resource = resource;
    how.version = version;
    record().uses.push_back(how);
    if (!is_write(how.access))
        return version;
    uint32_t& newest = graph_.resources_[resource].newest_version;
    newest = std::max(newest, version + 1);
    return version + 1;
}

Pass& Pass::sample(ImageId image, Sampling sampling)
{
    use(image.resource, image.version, true,
        {.access = read_by(record(), Access::compute_sampled, Access::raster_sampled), .sampling = sampling});
    return *this;
}

Pass& Pass::sample(BufferId buffer, Format texel)
{
    use(buffer.resource, buffer.version, false,
        {.access = read_by(record(), Access::compute_sampled, Access::raster_sampled), .texel = texel});
    return *this;
}

Pass& Pass::read(ImageId image)
{
    use(image.resource, image.version, true,
        {.access = read_by(record(), Access::compute_storage_read, Access::raster_storage_read)});
    return *this;
}

Pass& Pass::read(BufferId buffer)
{
    use(buffer.resource, buffer.version, false,
        {.access = read_by(record(), Access::compute_storage_read, Access::raster_storage_read)});
    return *this;
}

Pass& Pass::uniform(BufferId buffer)
{
    use(buffer.resource, buffer.version, false,
        {.access = read_by(record(), Access::compute_uniform, Access::raster_uniform)});
    return *this;
}

ImageId Pass::write(ImageId image)
{
    return {image.resource,
            use(image.resource, image.version, true, {.access = Access::compute_storage_write})};
}

BufferId Pass::write(BufferId buffer)
{
    return {buffer.resource,
            use(buffer.resource, buffer.version, false, {.access = Access::compute_storage_write})};
}

ImageId Pass::modify(ImageId image)
{
    return {image.resource,
            use(image.resource, image.version, true, {.access = Access::compute_storage_modify})};
}

BufferId Pass::modify(BufferId buffer)
{
    return {buffer.resource,
            use(buffer.resource, buffer.version, false, {.access = Access::compute_storage_modify})};
}

ImageId Pass::color(ImageId image)
{
    require_raster(record(), "color");
    require_format(record(), graph_, image, false);
    const bool clears = image.version == 0 && graph_.resources()[image.resource].imported_image == nullptr;
    return {
        image.resource,
        use(image.resource, image.version, true,
            {.access = clears ? Access::color_attachment : Access::color_attachment_modify, .bound = false})};
}

ImageId Pass::depth(ImageId image)
{
    require_raster(record(), "depth");
    require_format(record(), graph_, image, true);
    return {image.resource,
            use(image.resource, image.version, true, {.access = Access::depth_attachment, .bound = false})};
}

Pass& Pass::cull_back_faces()
{
    require_raster(record(), "culling");
    record().draw.cull_back_faces = true;
    return *this;
}

Pass& Pass::touch(ImageId image, Access access)
{
    require_kind(record(), access, false);
    use(image.resource, image.version, true, {.access = access, .bound = false});
    return *this;
}

Pass& Pass::touch(BufferId buffer, Access access)
{
    require_kind(record(), access, false);
    use(buffer.resource, buffer.version, false, {.access = access, .bound = false});
    return *this;
}

ImageId Pass::touch_write(ImageId image, Access access)
{
    require_kind(record(), access, true);
    return {image.resource, use(image.resource, image.version, true, {.access = access, .bound = false})};
}

BufferId Pass::touch_write(BufferId buffer, Access access)
{
    require_kind(record(), access, true);
    return {buffer.resource, use(buffer.resource, buffer.version, false, {.access = access, .bound = false})};
}

Pass& Pass::push_bytes(std::span<const std::byte> bytes)
{
    record().push.assign(bytes.begin(), bytes.end());
    return *this;
}

void Pass::dispatch_over(uint32_t width, uint32_t height, uint32_t layers)
{
    dispatch(groups_over(width), groups_over(height), layers);
}

void Pass::dispatch_over_page(uint32_t width, uint32_t height, uint32_t layers)
{
    dispatch(groups_over(width), (groups_over(height) + 3) / 4, layers);
}

Pass& Pass::variant(uint32_t bits)
{
    graph_.passes_[index_].variant = bits;
    return *this;
}

Pass& Pass::estimated_duration_us(uint32_t us)
{
    record().estimated_duration_us = us;
    return *this;
}

void Pass::dispatch_items(uint32_t count)
{
    constexpr uint32_t most_groups_x = 32768; // Vulkan guarantees 65535 workgroups per dimension
    const uint32_t groups = (count + 63) / 64;
    const uint32_t across = std::min(groups, most_groups_x);
    dispatch(across, across == 0 ? 0 : (groups + across - 1) / across);
}

void Pass::dispatch(uint32_t groups_x, uint32_t groups_y, uint32_t groups_z)
{
    record().dispatch = {.groups_x = groups_x, .groups_y = groups_y, .groups_z = groups_z};
}

void Pass::dispatch_indirect(BufferId arguments, uint64_t offset_bytes)
{
    use(arguments.resource, arguments.version, false, {.access = Access::indirect, .bound = false});
    record().dispatch = {.indirect_resource = arguments.resource, .indirect_offset_bytes = offset_bytes};
}

void Pass::draw(uint32_t vertex_count)
{
    require_raster(record(), "drawing");
    record().draw.vertex_count = vertex_count;
}

void Pass::draw_indirect(BufferId arguments)
{
    require_raster(record(), "drawing");
    use(arguments.resource, arguments.version, false, {.access = Access::indirect, .bound = false});
    record().draw.indirect_resource = arguments.resource;
}

void Pass::execute(const Recording& callback)
{
    record().record = callback;
}

Pass& Pass::keep()
{
    record().has_side_effect = true;
    return *this;
}

void Graph::clear()
{
    pass_count_ = 0;
    resource_count_ = 0;
}

PassRecord& Graph::new_pass(std::string_view name)
{
    if (pass_count_ == passes_.size()) {
        passes_.emplace_back();
    }
    PassRecord& pass = passes_[pass_count_++];
    pass.name = name;
    pass.shader = nullptr;
    pass.draw = {};
    pass.uses.clear();
    pass.push.clear();
    pass.variant = 0;
    pass.dispatch = {};
    pass.estimated_duration_us = 0;
    pass.record.clear();
    pass.has_side_effect = false;
    return pass;
}

ResourceRecord& Graph::new_resource(std::string_view name)
{
    if (resource_count_ == resources_.size()) {
        resources_.emplace_back();
    }
    ResourceRecord& resource = resources_[resource_count_++];
    std::string text = std::move(resource.name);
    text = name;
    resource = {.name = std::move(text)};
    return resource;
}

ImageId Graph::image(std::string_view name, ImageDesc desc)
{
    ResourceRecord& resource = new_resource(name);
    resource.is_image = true;
    resource.image = desc;
    return {resource_count_ - 1, 0};
}

BufferId Graph::buffer(std::string_view name, BufferDesc desc)
{
    new_resource(name).buffer = desc;
    return {resource_count_ - 1, 0};
}

ImageId Graph::import_image(std::string_view name, Image& image, const ImageDesc& desc, Layout initial_layout)
{
    return {take_in(name, {.name = {},
                           .is_image = true,
                           .image = desc,
                           .imported_image = &image,
                           .initial_layout = initial_layout}),
            0};
}

BufferId Graph::import_buffer(std::string_view name, Buffer& buffer, const BufferDesc& desc)
{
    return {take_in(name, {.name = {}, .buffer = desc, .imported_buffer = &buffer}), 0};
}

uint32_t Graph::take_in(std::string_view name, const ResourceRecord& imported)
{
    const auto all = resources();
    const auto known = std::ranges::find_if(all, [&](const ResourceRecord& resource) {
        return resource.is_imported() && resource.imported_image == imported.imported_image &&
               resource.imported_buffer == imported.imported_buffer;
    });
    const auto index = static_cast<uint32_t>(known - all.begin());
    if (known == all.end()) {
        ResourceRecord& taken = new_resource(name);
        taken.is_image = imported.is_image;
        taken.image = imported.image;
        taken.buffer = imported.buffer;
        taken.imported_image = imported.imported_image;
        taken.imported_buffer = imported.imported_buffer;
        taken.initial_layout = imported.initial_layout;
        return index;
    }
    const bool is_alike = known->image == imported.image && known->buffer == imported.buffer &&
                          known->initial_layout == imported.initial_layout;
    // If a pass has written the resource, the caller could mean the first version or the newest version.
    if (!is_alike || known->newest_version > 0) {
        throw std::logic_error(fmt::format("'{}' is imported again, as '{}', {}", known->name, name,
                                           is_alike ? "after a pass has written it: use that pass's handle"
                                                    : "but described otherwise"));
    }
    return index;
}

void Graph::export_image(ImageId image)
{
    mark_exported(image.resource, image.version, true);
}

void Graph::export_buffer(BufferId buffer)
{
    mark_exported(buffer.resource, buffer.version, false);
}

void Graph::mark_exported(uint32_t resource, uint32_t version, bool is_image)
{
    const ResourceRecord& wanted = checked(resource, is_image, "export");
    if (version != wanted.newest_version)
        throw std::logic_error(
            fmt::format("export: this version of '{}' has been overwritten; export the newest", wanted.name));
    resources_[resource].exported = true;
}

Pass Graph::compute(std::string_view name, const Shader& shader)
{
    new_pass(name).shader = &shader;
    return last_pass();
}

Pass Graph::raster(std::string_view name, const Shader& vertex, const Shader& fragment)
{
    new_pass(name).draw = {.vertex = &vertex, .fragment = &fragment};
    return last_pass();
}

Pass Graph::raster(std::string_view name, const Shader& vertex)
{
    new_pass(name).draw = {.vertex = &vertex};
    return last_pass();
}

Pass Graph::custom(std::string_view name)
{
    static_cast<void>(new_pass(name));
    return last_pass();
}

const ImageDesc& Graph::describe(ImageId image) const
{
    return checked(image.resource, true, "describe").image;
}

const BufferDesc& Graph::describe(BufferId buffer) const
{
    return checked(buffer.resource, false, "describe").buffer;
}

const ResourceRecord& Graph::checked(uint32_t resource, bool is_image, std::string_view user) const
{
    if (resource >= resource_count_)
        throw std::logic_error(fmt::format("'{}': resource {} is not of this graph", user, resource));
    if (resources_[resource].is_image != is_image)
        throw std::logic_error(fmt::format("'{}': the handle of '{}' is of another graph: it names {} here",
                                           user, resources_[resource].name,
                                           is_image ? "a buffer" : "an image"));
    return resources_[resource];
}

} // namespace estampe::gpu
