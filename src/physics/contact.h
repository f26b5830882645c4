/// Contact with the floor, implicit; contact between bodies, explicit.
///
/// Floor (docs/physics.md §4, (7)). A point at depth s, with velocity v, pushes with
///     f_n = k s − (c + k dt) v_z       while that is positive,
///     f_t = −c_t v_t,   c_t = min(μ f_n / √(|v_t|² + v_s²), m_f / dt)   (regularised Coulomb friction),
/// taken at the end of the step:  f_applied = f − W (J a + ω×(ω×arm)),  W = dt·diag(c_t, c_t, c + k dt),
/// J = [−arm×, 1]. The solver therefore adds Jᵀ W J to the body's inertia and −Jᵀ(f − W ω×(ω×arm)) to its
/// bias. The first pass takes f_n, c_t and the set of active contacts at the start of the step. Each later
/// pass takes them at the end of the step, as the previous pass predicts it.
///
/// Plates of the scene push by the same law, with their own k and c, and with a depth of at most
/// kMostPlatePush / k (docs/scenes.md, "The formula").
///
/// Self contact is a penalty force between capsules, equal and opposite at one common point, so that it does
/// not change the momentum of the whole body. It is explicit, with a stiffness low enough for that (model.h).
#pragma once

#include "physics/data.h"

namespace mimicx::physics {

/// Law of a floor contact: fills f, W_t, W_n with the coefficients taken at v_end.  docs/physics.md §4, (8)
template <class T>
void linearise_ground(const SimulationConfig& o, T dt, const Vec3<T>& v_end, GroundContact<T>& contact) {
  const T k = contact.surface.stiffness, depth = contact.surface.depth;
  const T damping = fma(dt, k, contact.surface.damping);
  const T f_end = fma(k, depth, -(damping * v_end.z));
  const auto pushes = (depth > T(0.0)) & (f_end > T(0.0));
  const T slip = sqrt(fma(v_end.x, v_end.x, fma(v_end.y, v_end.y, T(o.slip_speed * o.slip_speed))));
  const T c_t = min(T(o.friction) * f_end / slip, T(kMostFrictionMass) / dt);
  contact.f = {-c_t * contact.velocity.x, -c_t * contact.velocity.y,
               fma(k, depth, -(damping * contact.velocity.z))};
  contact.f = select<T>(pushes, contact.f, zero3<T>());
  contact.W_t = select(pushes, dt * c_t, T(0.0));
  contact.W_n = select(pushes, dt * damping, T(0.0));
}

/// Mask of the lanes whose point (x, y) is over a plate that is wider by `margin` on every side.
template <class T>
MaskOf<T> spans(const ModelPlate<RealOf<T>>& plate, const T& x, const T& y, const T& margin) {
  const T from_x = x - T(plate.x), from_y = y - T(plate.y), cosine(plate.cosine), sine(plate.sine);
  const T along = fma(cosine, from_x, sine * from_y), across = fma(cosine, from_y, -(sine * from_x));
  const MaskOf<T> in_length = max(along, -along) <= T(plate.half_x) + margin,
                  in_width = max(across, -across) <= T(plate.half_y) + margin;
  return in_length & in_width;
}

/// Height of the ground under a point, m: `Scene::height_under`.
template <class T>
T ground_height(const Model<RealOf<T>>& model, const Vec3<T>& p) {
  T height(0.0);
  for (const ModelPlate<RealOf<T>>& plate : model.plates) {
    const T top(plate.height);
    const MaskOf<T> higher = (p.z + T(Scene::kReach) > top) & (top > height);
    if (any(higher)) height = select(higher & spans(plate, p.x, p.y, T(0.0)), top, height);
  }
  return height;
}

/// The plates that some lane's character, or one body of it, may touch.
struct NearPlates {
  Array<int, kMaxPlates> index;  ///< in Model::plates
  int count = 0;
};
template <class T>
void find_near_plates(const Model<RealOf<T>>& model, const Vec3<T>& pelvis, NearPlates& out) {
  out.count = 0;
  for (int k = 0; k < model.plates.count(); ++k)
    if (any(spans(model.plates[k], pelvis.x, pelvis.y, T(model.span)))) out.index[out.count++] = k;
}

/// Those of them that a body is at the height of. @param z  of its joint centre
template <class T>
void find_level_plates(const Model<RealOf<T>>& model, const NearPlates& all, const T& z, RealOf<T> span,
                       NearPlates& out) {
  const double skin = model.config.skin, half = 0.5 * (Scene::kReach + skin);
  const T from(z + T(half)), far(span + static_cast<RealOf<T>>(half + skin));
  out.count = 0;
  for (int n = 0; n < all.count; ++n) {
    const T above = from - T(model.plates[all.index[n]].height);
    if (any(max(above, -above) < far)) out.index[out.count++] = all.index[n];
  }
}

/// Replaces the floor by the highest plate that spans the point and that the point is in, no deeper than its
/// reach. @param place  gives the point in world, m; asked only if the point is at the height of a plate
/// @param surface  the floor
template <class T, class Place>
void meet_plates(const Model<RealOf<T>>& model, const NearPlates& near, const Place& place,
                 GroundSurface<T>& surface) {
  const double reach = Scene::kReach + model.config.skin;
  const T half(0.5 * reach), above = surface.depth - half;  // of the middle of a plate's reach
  T deepest = surface.depth;
  for (int n = 0; n < near.count; ++n) {
    const ModelPlate<RealOf<T>>& plate = model.plates[near.index[n]];
    const T from_middle = above + T(plate.height);
    const MaskOf<T> in = max(from_middle, -from_middle) < half;  // 0 < depth < reach
    if (!any(in)) continue;
    const Vec3<T> p = place();
    const T depth = from_middle + half, most(plate.most_depth);
    const MaskOf<T> here = in & (depth > deepest) & spans(plate, p.x, p.y, T(0.0));
    deepest = select(here, depth, deepest);
    surface.depth = select(here, min(depth, most), surface.depth);
    surface.stiffness = select(here, T(plate.stiffness), surface.stiffness);
    surface.damping = select(here, T(plate.damping), surface.damping);
  }
  surface.capped = surface.depth < deepest;
}

/// Finds the points that touch in any lane and linearises them at the start of the step.
template <class T>
[[gnu::flatten]] void detect_ground(const Model<RealOf<T>>& model, Data<T>& d) {
  const SimulationConfig& o = model.config;
  d.ground_count = 0;
  NearPlates near, level;
  if (!model.plates.empty()) find_near_plates(model, d.p_WB[0], near);
  int levelled = -1;  // the body that `level` is of; contacts are sorted by body
  for (int index = 0; index < static_cast<int>(model.contacts.size()); ++index) {
    const ContactPoint& point = model.contacts[index];
    const int i = point.body;
    const Mat3<T>& R = d.R_WB[i];
    const T x(point.p_B.x()), y(point.p_B.y()), z(point.p_B.z()), radius(point.radius);
    const T centre_z = fma(R.c[0].z, x, fma(R.c[1].z, y, R.c[2].z * z));
    GroundSurface<T> surface{T(o.skin) + radius - (d.p_WB[i].z + centre_z), T(o.ground_stiffness),
                             T(o.ground_damping), T(0.0) > T(0.0)};
    if (near.count > 0) {
      if (i != levelled) find_level_plates(model, near, d.p_WB[i].z, model.contact_span[i], level);
      levelled = i;
      meet_plates(
          model, level,
          [&] {
            return d.p_WB[i] + R * Vec3<T>{x, y, z};
          },
          surface);
    }
    if (!any(surface.depth > T(0.0))) continue;
    GroundContact<T>& contact = d.ground[d.ground_count++];
    contact.index = index;
    contact.surface = surface;
    contact.arm = R * Vec3<T>{x, y, z};
    contact.arm.z -= radius;
    const Vec3<T> w_x_arm = cross(d.w[i], contact.arm);
    contact.velocity = d.v[i] + w_x_arm;
    contact.centripetal = cross(d.w[i], w_x_arm);
    linearise_ground(o, T(model.dt), contact.velocity, contact);
  }
}

/// Adds a contact to the articulated inertia and bias of its body:                  docs/physics.md §4, (9)
///     IA += Jᵀ W J,   pA −= Jᵀ (f − W ω×(ω×arm)),   J = [−arm×, 1],   W = diag(W_t, W_t, W_n);
/// in the blocks of IA = [A B; Bᵀ C], with a = arm:   A += a× W (a×)ᵀ,   B += a× W,   C += W.
template <class T>
void add_ground(const GroundContact<T>& c, Inertia<T>& IA, Wrench<T>& pA) {
  const Vec3<T>& a = c.arm;
  const T wx = c.W_t * a.x, wy = c.W_t * a.y, wz = c.W_t * a.z, nx = c.W_n * a.x, ny = c.W_n * a.y;
  IA.A.xx += fma(wz, a.z, ny * a.y);
  IA.A.yy += fma(wz, a.z, nx * a.x);
  IA.A.zz += fma(wx, a.x, wy * a.y);
  IA.A.xy -= nx * a.y;
  IA.A.xz -= wx * a.z;
  IA.A.yz -= wy * a.z;
  IA.B.c[0].y += wz;
  IA.B.c[0].z -= wy;
  IA.B.c[1].x -= wz;
  IA.B.c[1].z += wx;
  IA.B.c[2].x += ny;
  IA.B.c[2].y -= nx;
  IA.C.xx += c.W_t;
  IA.C.yy += c.W_t;
  IA.C.zz += c.W_n;
  const Vec3<T> f = {fma(-c.W_t, c.centripetal.x, c.f.x), fma(-c.W_t, c.centripetal.y, c.f.y),
                     fma(-c.W_n, c.centripetal.z, c.f.z)};
  pA.f -= f;
  pA.n -= cross(a, f);
}

/// Acceleration of the touching point after a solve.
template <class T>
Vec3<T> point_acceleration(const Model<RealOf<T>>& model, const GroundContact<T>& c, const Data<T>& d) {
  const int i = model.contacts[c.index].body;
  return d.a_v[i] + cross(d.a_w[i], c.arm) + c.centripetal;
}

/// Between two solves: takes the coefficients at the velocities that the previous solve predicts, in the
/// given lanes.
template <class T>
[[gnu::flatten]] void relinearise_ground(const Model<RealOf<T>>& model, const MaskOf<T>& lanes, Data<T>& d) {
  for (int k = 0; k < d.ground_count; ++k) {
    GroundContact<T>& c = d.ground[k];
    GroundContact<T> renewed = c;
    const Vec3<T> v_end = add_scaled(c.velocity, T(model.dt), point_acceleration(model, c, d));
    linearise_ground(model.config, T(model.dt), v_end, renewed);
    c.f = select<T>(lanes, renewed.f, c.f);
    c.W_t = select(lanes, renewed.W_t, c.W_t);
    c.W_n = select(lanes, renewed.W_n, c.W_n);
    d.outdated[model.contacts[c.index].body] = true;
  }
}

/// After the last solve: the forces that acted.
template <class T>
[[gnu::flatten]] void find_applied_ground(const Model<RealOf<T>>& model, Data<T>& d) {
  for (int k = 0; k < d.ground_count; ++k) {
    GroundContact<T>& c = d.ground[k];
    const Vec3<T> a = point_acceleration(model, c, d);
    c.applied = {fma(-c.W_t, a.x, c.f.x), fma(-c.W_t, a.y, c.f.y), fma(-c.W_n, a.z, c.f.z)};
  }
}

/// Closest points of two segments p + s·u and q + t·w, s, t in [0, 1]; fills s and t.
/// Branch-free form of Ericson, "Real-Time Collision Detection" (2005), §5.1.9.
template <class T>
void closest_on_segments(const Vec3<T>& p, const Vec3<T>& u, const Vec3<T>& q, const Vec3<T>& w, T& s, T& t) {
  const T zero(0.0), one(1.0), tiny(1e-9);
  const Vec3<T> r = p - q;
  const T a = max(dot(u, u), tiny), e = max(dot(w, w), tiny), f = dot(w, r), c = dot(u, r), b = dot(u, w);
  const T denominator = max(fma(a, e, -(b * b)), tiny);
  const auto clamp01 = [&](T x) { return min(max(x, zero), one); };
  s = clamp01(fma(b, f, -(c * e)) / denominator);
  t = fma(b, s, f) / e;
  const T clamped = clamp01(t);
  s = select((t < zero) | (t > one), clamp01(fma(b, clamped, -c) / a), s);
  t = clamped;
}

/// Adds penalty forces between capsules to the bias of both bodies, and keeps them for export.
template <class T>
[[gnu::flatten]] void add_self_contact(const Model<RealOf<T>>& model, Data<T>& d) {
  const T k(model.config.self_stiffness), damping(model.config.self_damping), zero(0.0);
  PerBody<Vec3<T>> arm, axis, middle;  // start of the capsule's axis, its vector; its middle in world
  for (const int i : model.capsule_bodies) {
    const Capsule& c = model.capsule[i];
    const Vector3d along = c.b_B - c.a_B;
    arm[i] = d.R_WB[i] * Vec3<T>{T(c.a_B.x()), T(c.a_B.y()), T(c.a_B.z())};
    axis[i] = d.R_WB[i] * Vec3<T>{T(along.x()), T(along.y()), T(along.z())};
    middle[i] = add_scaled(d.p_WB[i] + arm[i], T(0.5), axis[i]);
  }
  for (const auto& [i, j] : model.self_pairs) {
    const Capsule &capsule_i = model.capsule[i], &capsule_j = model.capsule[j];
    const double reach =
        0.5 * ((capsule_i.b_B - capsule_i.a_B).norm() + (capsule_j.b_B - capsule_j.a_B).norm()) +
        capsule_i.radius + capsule_j.radius;
    const Vec3<T> apart = middle[i] - middle[j];
    if (!any(dot(apart, apart) < T(reach * reach))) continue;
    T s, t;
    const Vec3<T> start_i = d.p_WB[i] + arm[i], start_j = d.p_WB[j] + arm[j];
    closest_on_segments(start_i, axis[i], start_j, axis[j], s, t);
    const Vec3<T> on_i = add_scaled(start_i, s, axis[i]), on_j = add_scaled(start_j, t, axis[j]);
    const Vec3<T> gap = on_i - on_j;
    const T distance = max(norm(gap), T(1e-6));
    const T depth = T(capsule_i.radius + capsule_j.radius) - distance;
    if (!any(depth > zero)) continue;
    const Vec3<T> normal = (T(1.0) / distance) * gap;
    // The point in the middle of the overlap, on both bodies.
    const Vec3<T> point = add_scaled(on_j, T(capsule_j.radius) - T(0.5) * depth, normal);
    const Vec3<T> arm_i = point - d.p_WB[i], arm_j = point - d.p_WB[j];
    const Vec3<T> v = (d.v[i] + cross(d.w[i], arm_i)) - (d.v[j] + cross(d.w[j], arm_j));
    const T push = max(fma(k, depth, -(damping * dot(v, normal))), zero);
    const Vec3<T> f = select(depth > zero, push, zero) * normal;
    d.self_wrench[i].f += f;
    d.self_wrench[i].n += cross(arm_i, f);
    d.self_wrench[j].f -= f;
    d.self_wrench[j].n -= cross(arm_j, f);
  }
  for (const int i : model.capsule_bodies) {
    d.bias[i].f -= d.self_wrench[i].f;
    d.bias[i].n -= d.self_wrench[i].n;
  }
}

}  // namespace mimicx::physics
