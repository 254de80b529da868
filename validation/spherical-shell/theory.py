# SPDX-License-Identifier: BSD-3-Clause
"""Small oscillations of an elastic spherical shell full of fluid, in fluid without bound.

Displacements w P_n(cos theta) along the radius, u dP_n/dtheta along the meridians, all times exp(s t). Flow of the unsteady Stokes
equations (Lamb 1932, art. 353: solid harmonics and modified spherical Bessel functions of q r, q^2 = s/nu),

    v_r = n(n+1) chi/r P_n,   v_theta = (1/r) d(r chi)/dr dP_n/dtheta,
    chi = a r^n + b i_n(q r) inside,  chi = a r^-(n+1) + b k_n(q r) outside,

of which the harmonic part alone has a pressure, -rho s (n+1) a r^n and rho s n a r^-(n+1). On the shell the fluid moves with it; the
jump of traction balances inertia and elasticity, m s^2 d + K d = f. K follows from the energy of Love's shell,

    E h/(2(1-nu_s^2)) int (e_1^2 + e_2^2 + 2 nu_s e_1 e_2) dA + D/2 int (k_1^2 + k_2^2 + 2 nu_s k_1 k_2) dA,
    e_1 = (u' + w)/R, e_2 = (u cot theta + w)/R, k_1 = (u' - w'')/R^2, k_2 = cot theta (u - w')/R^2.

A root s of the determinant gives frequency and decay.
"""
import numpy as np


def legendre(n, theta):
    """P_n, dP_n/dtheta, d2P_n/dtheta2."""
    p = np.polynomial.legendre.Legendre.basis(n)
    x, sine = np.cos(theta), np.sin(theta)
    return p(x), -sine * p.deriv(1)(x), sine**2 * p.deriv(2)(x) - x * p.deriv(1)(x)


def stiffness(n, radius, thickness, young, poisson):
    """K over (w, u), divided by int P_n^2 dA."""
    node, weight = np.polynomial.legendre.leggauss(40)
    theta = np.arccos(node)
    p, dp, ddp = legendre(n, theta)
    cot = 1 / np.tan(theta)
    e_1, e_2 = np.array([p, ddp]) / radius, np.array([p, cot * dp]) / radius
    k_1, k_2 = np.array([-ddp, ddp]) / radius**2, np.array([-cot * dp, cot * dp]) / radius**2

    def energy(a, b, modulus):
        pair = lambda f, g: np.einsum("it,jt,t->ij", f, g, weight)
        return modulus * (pair(a, a) + pair(b, b) + poisson * (pair(a, b) + pair(b, a)))

    membrane = young * thickness / (1 - poisson**2)
    bending = young * thickness**3 / 12 / (1 - poisson**2)
    return (energy(e_1, e_2, membrane) + energy(k_1, k_2, bending)) / np.sum(weight * p**2)


def bessel(n, z, kind):
    """Modified spherical Bessel function and its first two derivatives; `kind` 1: regular at 0, 2: decays. By recursion from
    closed forms, scaled by exp(-z) and exp(z): constants that the amplitudes take up."""
    decay = np.exp(-2 * z)
    if kind == 1:
        f = [(1 - decay) / (2 * z), ((1 + decay) - (1 - decay) / z) / (2 * z)]
        step = lambda k: f[k - 1] - (2 * k + 1) / z * f[k]
    else:
        f = [1 / z, (1 + 1 / z) / z]
        step = lambda k: f[k - 1] + (2 * k + 1) / z * f[k]
    for k in range(1, n + 1):
        f.append(step(k))
    value = f[n]
    first = f[n + 1] + n / z * value if kind == 1 else -f[n + 1] + n / z * value
    second = (1 + n * (n + 1) / z**2) * value - 2 / z * first
    return value, first, second


def fluid(n, s, radius, density, viscosity):
    """Force of the fluid on the shell per velocity, 2 x 2 over (radial, meridional)."""
    q = np.sqrt(s / viscosity)
    total = np.zeros((2, 2), complex)
    for side in (-1, 1):  # inside, outside
        power = n if side < 0 else -(n + 1)
        harmonic = (1.0, power / radius, power * (power - 1) / radius**2)
        value, first, second = bessel(n, q * radius, 1 if side < 0 else 2)
        pressure = (-(n + 1) if side < 0 else n) * density * s
        velocity, traction = [], []
        for (chi, d_chi, dd_chi), p in ((harmonic, pressure), ((value, q * first, q * q * second), 0.0)):
            v_r = n * (n + 1) * chi / radius
            dv_r = n * (n + 1) * (d_chi / radius - chi / radius**2)
            v_t = chi / radius + d_chi
            dv_t = d_chi / radius - chi / radius**2 + dd_chi
            velocity.append((v_r, v_t))
            mu = density * viscosity
            traction.append((-p + 2 * mu * dv_r, mu * (dv_t - v_t / radius + v_r / radius)))
        total += side * np.array(traction).T @ np.linalg.inv(np.array(velocity).T)
    return total


def root(n, radius, thickness, young, poisson, shell_density, density, viscosity):
    """s of the mode that deforms the shell least in its own surface, by the secant rule from the inviscid frequency."""
    weights = np.diag([1.0, n * (n + 1)])
    K = stiffness(n, radius, thickness, young, poisson)
    added = density * radius * (1 / n + 1 / (n + 1))
    mass = shell_density * thickness * weights + np.diag([added, 0.0])
    frequency = np.sqrt(np.min(np.linalg.eigvals(np.linalg.solve(mass, K)).real))

    def equation(s):
        return np.linalg.det(shell_density * thickness * s**2 * weights + K - s * weights @ fluid(n, s, radius, density, viscosity))

    before, s = 1j * frequency, (-0.05 + 0.95j) * frequency
    f_before, f = equation(before), equation(s)
    for _ in range(100):
        before, s, f_before = s, s - f * (s - before) / (f - f_before), f
        if abs(s - before) < 1e-12 * abs(s):
            return s, frequency
        f = equation(s)
    raise ArithmeticError("the secant rule did not converge")
