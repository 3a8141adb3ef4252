//! Dimensions: what a number measures, as exponents of the SI base quantities.

use std::fmt;

/// Exponents of length, mass, time, current, temperature, amount, luminous intensity.
///
/// ```
/// use expr::Dimension;
/// assert_eq!(Dimension::CURRENT.times(Dimension::RESISTANCE), Dimension::VOLTAGE);
/// assert_eq!(Dimension::VOLTAGE.to_string(), "kg*m^2/s^3/A");
/// assert_eq!(Dimension::VOLTAGE.named(), Some("Voltage"));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Dimension(pub [i8; 7]);

/// Names of quantities; of several names for one dimension the first is shown.
const NAMES: [(&str, Dimension); 96] = [
    ("Real", Dimension::NONE),
    ("Angle", Dimension::ANGLE),
    ("Length", Dimension::LENGTH),
    ("Area", Dimension::AREA),
    ("Volume", Dimension::VOLUME),
    ("Mass", Dimension::MASS),
    ("Time", Dimension::TIME),
    ("Current", Dimension::CURRENT),
    ("Temperature", Dimension::TEMPERATURE),
    ("Amount", Dimension::AMOUNT),
    ("LuminousIntensity", Dimension::LUMINOUS_INTENSITY),
    ("Velocity", Dimension::VELOCITY),
    ("Speed", Dimension::VELOCITY),
    ("Acceleration", Dimension::ACCELERATION),
    ("Momentum", Dimension::MOMENTUM),
    ("Force", Dimension::FORCE),
    ("Pressure", Dimension::PRESSURE),
    ("Stress", Dimension::PRESSURE),
    ("Energy", Dimension::ENERGY),
    ("Moment", Dimension::MOMENT),
    ("Torque", Dimension::MOMENT),
    ("Power", Dimension::POWER),
    ("Voltage", Dimension::VOLTAGE),
    ("Resistance", Dimension::RESISTANCE),
    ("Conductance", Dimension::CONDUCTANCE),
    ("Capacitance", Dimension::CAPACITANCE),
    ("Inductance", Dimension::INDUCTANCE),
    ("Charge", Dimension::CHARGE),
    ("Frequency", Dimension::FREQUENCY),
    ("AngularVelocity", Dimension::FREQUENCY),
    ("AngularAcceleration", Dimension::ANGULAR_ACCELERATION),
    ("Stiffness", Dimension::STIFFNESS),
    ("Damping", Dimension::DAMPING),
    ("Density", Dimension::DENSITY),
    ("MomentOfInertia", Dimension::MOMENT_OF_INERTIA),
    ("SecondMomentOfArea", Dimension::SECOND_MOMENT_OF_AREA),
    ("MagneticFlux", Dimension::MAGNETIC_FLUX),
    ("MagneticFluxDensity", Dimension::MAGNETIC_FLUX_DENSITY),
    ("ElectricField", Dimension::ELECTRIC_FIELD),
    ("Resistivity", Dimension::RESISTIVITY),
    ("Conductivity", Dimension::CONDUCTIVITY),
    ("Viscosity", Dimension::VISCOSITY),
    ("Diffusivity", Dimension::DIFFUSIVITY),
    ("VolumeFlow", Dimension::VOLUME_FLOW),
    ("MassFlow", Dimension::MASS_FLOW),
    ("HeatCapacity", Dimension::HEAT_CAPACITY),
    ("SpecificHeat", Dimension::SPECIFIC_HEAT),
    ("ThermalConductivity", Dimension::THERMAL_CONDUCTIVITY),
    ("HeatFlux", Dimension::HEAT_FLUX),
    ("Dose", Dimension::DOSE),
    ("AngularMomentum", Dimension::ANGULAR_MOMENTUM),
    ("MolarMass", Dimension::MOLAR_MASS),
    ("Illuminance", Dimension::ILLUMINANCE),
    ("Impedance", Dimension::RESISTANCE),
    ("Work", Dimension::ENERGY),
    ("Weight", Dimension::FORCE),
    ("Entropy", Dimension::HEAT_CAPACITY),
    ("SpecificEnergy", Dimension::DOSE),
    ("KinematicViscosity", Dimension::DIFFUSIVITY),
    ("Irradiance", Dimension::HEAT_FLUX),
    ("LuminousFlux", Dimension::LUMINOUS_INTENSITY),
    ("ElasticModulus", Dimension::PRESSURE),
    ("SectionModulus", Dimension::VOLUME),
    ("ReactivePower", Dimension::POWER),
    ("MolarHeatCapacity", Dimension::MOLAR_HEAT_CAPACITY),
    ("Concentration", Dimension::CONCENTRATION),
    ("AreaDensity", Dimension::AREA_DENSITY),
    ("HeatTransferCoefficient", Dimension::HEAT_TRANSFER),
    ("ThermalExpansion", Dimension::THERMAL_EXPANSION),
    ("Permittivity", Dimension::PERMITTIVITY),
    ("Permeability", Dimension::PERMEABILITY),
    ("ThermalResistance", Dimension::THERMAL_RESISTANCE),
    ("ThermalConductance", Dimension::THERMAL_CONDUCTANCE),
    ("HeatFlow", Dimension::POWER),
    ("BendingStiffness", Dimension::BENDING_STIFFNESS),
    ("RotationalStiffness", Dimension::ENERGY),
    ("LineLoad", Dimension::STIFFNESS),
    ("SurfaceTension", Dimension::STIFFNESS),
    ("LineDensity", Dimension::LINE_DENSITY),
    ("SpecificVolume", Dimension::SPECIFIC_VOLUME),
    ("PressureGradient", Dimension::PRESSURE_GRADIENT),
    ("SpecificWeight", Dimension::PRESSURE_GRADIENT),
    ("FlowResistance", Dimension::FLOW_RESISTANCE),
    ("Jerk", Dimension::JERK),
    ("Curvature", Dimension::CURVATURE),
    ("WaveNumber", Dimension::CURVATURE),
    ("CurrentDensity", Dimension::CURRENT_DENSITY),
    ("MagneticField", Dimension::MAGNETIC_FIELD),
    ("GravitationalConstant", Dimension::GRAVITATION),
    ("RadiationConstant", Dimension::RADIATION),
    ("MolarCharge", Dimension::MOLAR_CHARGE),
    ("ReciprocalAmount", Dimension::RECIPROCAL_AMOUNT),
    ("MolarEnergy", Dimension::MOLAR_ENERGY),
    ("MolarVolume", Dimension::MOLAR_VOLUME),
    ("PowerDensity", Dimension::POWER_DENSITY),
    ("Compressibility", Dimension::COMPRESSIBILITY),
];

/// The base units in the order in which they are written, each with its place in a dimension.
const BASE_UNITS: [(&str, usize); 7] =
    [("kg", 1), ("m", 0), ("s", 2), ("A", 3), ("K", 4), ("mol", 5), ("cd", 6)];

impl Dimension {
    /// A plain number.
    pub const NONE: Self = Self([0; 7]);
    /// Length, m.
    pub const LENGTH: Self = Self([1, 0, 0, 0, 0, 0, 0]);
    /// Area, m².
    pub const AREA: Self = Self([2, 0, 0, 0, 0, 0, 0]);
    /// Volume, m³.
    pub const VOLUME: Self = Self([3, 0, 0, 0, 0, 0, 0]);
    /// Angle: a plain number, in radians.
    pub const ANGLE: Self = Self::NONE;
    /// Mass, kg.
    pub const MASS: Self = Self([0, 1, 0, 0, 0, 0, 0]);
    /// Time, s.
    pub const TIME: Self = Self([0, 0, 1, 0, 0, 0, 0]);
    /// Electric current, A.
    pub const CURRENT: Self = Self([0, 0, 0, 1, 0, 0, 0]);
    /// Temperature, K.
    pub const TEMPERATURE: Self = Self([0, 0, 0, 0, 1, 0, 0]);
    /// Amount of substance, mol.
    pub const AMOUNT: Self = Self([0, 0, 0, 0, 0, 1, 0]);
    /// Luminous intensity, cd.
    pub const LUMINOUS_INTENSITY: Self = Self([0, 0, 0, 0, 0, 0, 1]);
    /// Velocity, m/s.
    pub const VELOCITY: Self = Self([1, 0, -1, 0, 0, 0, 0]);
    /// Acceleration, m/s².
    pub const ACCELERATION: Self = Self([1, 0, -2, 0, 0, 0, 0]);
    /// Momentum, N·s.
    pub const MOMENTUM: Self = Self([1, 1, -1, 0, 0, 0, 0]);
    /// Force, N.
    pub const FORCE: Self = Self([1, 1, -2, 0, 0, 0, 0]);
    /// Pressure and stress, Pa.
    pub const PRESSURE: Self = Self([-1, 1, -2, 0, 0, 0, 0]);
    /// Energy, J.
    pub const ENERGY: Self = Self([2, 1, -2, 0, 0, 0, 0]);
    /// Moment of a force (torque), N·m.
    pub const MOMENT: Self = Self::ENERGY;
    /// Power, W.
    pub const POWER: Self = Self([2, 1, -3, 0, 0, 0, 0]);
    /// Voltage, V.
    pub const VOLTAGE: Self = Self([2, 1, -3, -1, 0, 0, 0]);
    /// Electric resistance, Ω.
    pub const RESISTANCE: Self = Self([2, 1, -3, -2, 0, 0, 0]);
    /// Electric conductance, S.
    pub const CONDUCTANCE: Self = Self([-2, -1, 3, 2, 0, 0, 0]);
    /// Capacitance, F.
    pub const CAPACITANCE: Self = Self([-2, -1, 4, 2, 0, 0, 0]);
    /// Inductance, H.
    pub const INDUCTANCE: Self = Self([2, 1, -2, -2, 0, 0, 0]);
    /// Electric charge, C.
    pub const CHARGE: Self = Self([0, 0, 1, 1, 0, 0, 0]);
    /// Frequency and angular velocity, 1/s.
    pub const FREQUENCY: Self = Self([0, 0, -1, 0, 0, 0, 0]);
    /// Angular acceleration, 1/s².
    pub const ANGULAR_ACCELERATION: Self = Self([0, 0, -2, 0, 0, 0, 0]);
    /// Stiffness of a spring, N/m.
    pub const STIFFNESS: Self = Self([0, 1, -2, 0, 0, 0, 0]);
    /// Damping, N·s/m.
    pub const DAMPING: Self = Self([0, 1, -1, 0, 0, 0, 0]);
    /// Density, kg/m³.
    pub const DENSITY: Self = Self([-3, 1, 0, 0, 0, 0, 0]);
    /// Moment of inertia, kg·m².
    pub const MOMENT_OF_INERTIA: Self = Self([2, 1, 0, 0, 0, 0, 0]);
    /// Second moment of area, m⁴.
    pub const SECOND_MOMENT_OF_AREA: Self = Self([4, 0, 0, 0, 0, 0, 0]);
    /// Magnetic flux, Wb.
    pub const MAGNETIC_FLUX: Self = Self([2, 1, -2, -1, 0, 0, 0]);
    /// Magnetic flux density, T.
    pub const MAGNETIC_FLUX_DENSITY: Self = Self([0, 1, -2, -1, 0, 0, 0]);
    /// Electric field strength, V/m.
    pub const ELECTRIC_FIELD: Self = Self([1, 1, -3, -1, 0, 0, 0]);
    /// Electric resistivity, Ω·m.
    pub const RESISTIVITY: Self = Self([3, 1, -3, -2, 0, 0, 0]);
    /// Electric conductivity, S/m.
    pub const CONDUCTIVITY: Self = Self([-3, -1, 3, 2, 0, 0, 0]);
    /// Dynamic viscosity, Pa·s.
    pub const VISCOSITY: Self = Self([-1, 1, -1, 0, 0, 0, 0]);
    /// Diffusivity and kinematic viscosity, m²/s.
    pub const DIFFUSIVITY: Self = Self([2, 0, -1, 0, 0, 0, 0]);
    /// Flow of volume, m³/s.
    pub const VOLUME_FLOW: Self = Self([3, 0, -1, 0, 0, 0, 0]);
    /// Flow of mass, kg/s; the dimension is that of damping.
    pub const MASS_FLOW: Self = Self([0, 1, -1, 0, 0, 0, 0]);
    /// Heat capacity and entropy, J/K.
    pub const HEAT_CAPACITY: Self = Self([2, 1, -2, 0, -1, 0, 0]);
    /// Specific heat capacity, J/(kg·K).
    pub const SPECIFIC_HEAT: Self = Self([2, 0, -2, 0, -1, 0, 0]);
    /// Thermal conductivity, W/(m·K).
    pub const THERMAL_CONDUCTIVITY: Self = Self([1, 1, -3, 0, -1, 0, 0]);
    /// Heat flux and irradiance, W/m².
    pub const HEAT_FLUX: Self = Self([0, 1, -3, 0, 0, 0, 0]);
    /// Absorbed dose and specific energy, J/kg.
    pub const DOSE: Self = Self([2, 0, -2, 0, 0, 0, 0]);
    /// Angular momentum and action, J·s.
    pub const ANGULAR_MOMENTUM: Self = Self([2, 1, -1, 0, 0, 0, 0]);
    /// Molar mass, kg/mol.
    pub const MOLAR_MASS: Self = Self([0, 1, 0, 0, 0, -1, 0]);
    /// Molar heat capacity, the dimension of the gas constant, J/(mol·K).
    pub const MOLAR_HEAT_CAPACITY: Self = Self([2, 1, -2, 0, -1, -1, 0]);
    /// Concentration, mol/m³.
    pub const CONCENTRATION: Self = Self([-3, 0, 0, 0, 0, 1, 0]);
    /// Mass of an area, kg/m².
    pub const AREA_DENSITY: Self = Self([-2, 1, 0, 0, 0, 0, 0]);
    /// Heat transfer coefficient, W/(m²·K).
    pub const HEAT_TRANSFER: Self = Self([0, 1, -3, 0, -1, 0, 0]);
    /// Coefficient of thermal expansion, 1/K.
    pub const THERMAL_EXPANSION: Self = Self([0, 0, 0, 0, -1, 0, 0]);
    /// Permittivity, F/m.
    pub const PERMITTIVITY: Self = Self([-3, -1, 4, 2, 0, 0, 0]);
    /// Permeability, H/m.
    pub const PERMEABILITY: Self = Self([1, 1, -2, -2, 0, 0, 0]);
    /// Illuminance, lx.
    pub const ILLUMINANCE: Self = Self([-2, 0, 0, 0, 0, 0, 1]);
    /// Thermal resistance, K/W.
    pub const THERMAL_RESISTANCE: Self = Self([-2, -1, 3, 0, 1, 0, 0]);
    /// Thermal conductance, W/K.
    pub const THERMAL_CONDUCTANCE: Self = Self([2, 1, -3, 0, -1, 0, 0]);
    /// Bending stiffness of a beam, N·m².
    pub const BENDING_STIFFNESS: Self = Self([3, 1, -2, 0, 0, 0, 0]);
    /// Mass of a metre, kg/m.
    pub const LINE_DENSITY: Self = Self([-1, 1, 0, 0, 0, 0, 0]);
    /// Volume of a kilogram, m³/kg.
    pub const SPECIFIC_VOLUME: Self = Self([3, -1, 0, 0, 0, 0, 0]);
    /// Pressure lost on a metre, Pa/m; weight of a volume, N/m³.
    pub const PRESSURE_GRADIENT: Self = Self([-2, 1, -2, 0, 0, 0, 0]);
    /// Resistance to a flow, Pa·s/m³.
    pub const FLOW_RESISTANCE: Self = Self([-4, 1, -1, 0, 0, 0, 0]);
    /// Jerk, m/s³.
    pub const JERK: Self = Self([1, 0, -3, 0, 0, 0, 0]);
    /// Curvature, refractive power, wave number, 1/m.
    pub const CURVATURE: Self = Self([-1, 0, 0, 0, 0, 0, 0]);
    /// Current through an area, A/m².
    pub const CURRENT_DENSITY: Self = Self([-2, 0, 0, 1, 0, 0, 0]);
    /// Magnetic field, A/m.
    pub const MAGNETIC_FIELD: Self = Self([-1, 0, 0, 1, 0, 0, 0]);
    /// Force of gravitation between two kilograms a metre apart, N·m²/kg².
    pub const GRAVITATION: Self = Self([3, -1, -2, 0, 0, 0, 0]);
    /// What a surface radiates by the fourth power of its temperature, W/(m²·K⁴).
    pub const RADIATION: Self = Self([0, 1, -3, 0, -4, 0, 0]);
    /// Charge of a mole, C/mol.
    pub const MOLAR_CHARGE: Self = Self([0, 0, 1, 1, 0, -1, 0]);
    /// Number in a mole, 1/mol.
    pub const RECIPROCAL_AMOUNT: Self = Self([0, 0, 0, 0, 0, -1, 0]);
    /// Energy of a mole, J/mol.
    pub const MOLAR_ENERGY: Self = Self([2, 1, -2, 0, 0, -1, 0]);
    /// Volume of a mole, m³/mol.
    pub const MOLAR_VOLUME: Self = Self([3, 0, 0, 0, 0, -1, 0]);
    /// Power of a volume, W/m³.
    pub const POWER_DENSITY: Self = Self([-1, 1, -3, 0, 0, 0, 0]);
    /// Compressibility, 1/Pa.
    pub const COMPRESSIBILITY: Self = Self([1, -1, 2, 0, 0, 0, 0]);

    /// Returns true for a plain number.
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }
    fn map(self, exponent: impl Fn(usize, i8) -> i8) -> Self {
        Self(std::array::from_fn(|i| exponent(i, self.0[i])))
    }
    /// Returns the dimension of a product. Exponents stop at the ends of `i8`.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        self.map(|i, e| e.saturating_add(other.0[i]))
    }
    /// Returns the dimension of a quotient.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        self.map(|i, e| e.saturating_sub(other.0[i]))
    }
    /// Returns the dimension of the `n`th power.
    #[must_use]
    pub fn power(self, n: i8) -> Self {
        self.map(|_, e| e.saturating_mul(n))
    }
    /// Returns the dimension of the `n`th root, if its exponents are whole.
    pub fn root(self, n: i8) -> Option<Self> {
        let is_whole = n != 0 && self.0.iter().all(|e| e.wrapping_rem(n) == 0);
        is_whole.then(|| self.map(|_, e| e.saturating_div(n)))
    }
    /// Returns the name of the quantity, if it has one: `Voltage`.
    pub fn named(self) -> Option<&'static str> {
        NAMES.iter().find(|(_, dimension)| *dimension == self).map(|(name, _)| *name)
    }
    /// Returns the dimension of a named quantity; `Angle` and `Real` are plain numbers.
    pub fn by_name(name: &str) -> Option<Self> {
        NAMES.iter().find(|(n, _)| *n == name).map(|(_, dimension)| *dimension)
    }
    /// Returns the names of all quantities.
    pub fn names() -> impl Iterator<Item = &'static str> {
        NAMES.iter().map(|(name, _)| *name)
    }
}

/// Writes base units: `kg*m^2/s^3/A`, `1/s`; a plain number is `1`.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut above = 0;
        for (unit, place) in BASE_UNITS {
            let exponent = self.0[place];
            if exponent > 0 {
                let times = if above > 0 { "*" } else { "" };
                write!(f, "{times}{unit}")?;
                above += 1;
            }
            if exponent > 1 {
                write!(f, "^{exponent}")?;
            }
        }
        if above == 0 {
            write!(f, "1")?;
        }
        for (unit, place) in BASE_UNITS {
            let exponent = self.0[place];
            if exponent < 0 {
                write!(f, "/{unit}")?;
            }
            if exponent < -1 {
                write!(f, "^{}", exponent.unsigned_abs())?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_whole_or_none() {
        assert_eq!(Dimension::AREA.root(2), Some(Dimension::LENGTH));
        assert_eq!(Dimension::LENGTH.root(2), None);
        assert_eq!(Dimension::LENGTH.root(0), None);
        assert_eq!(Dimension([i8::MIN; 7]).root(-1), Some(Dimension([i8::MAX; 7])));
    }
    #[test]
    fn laws_of_physics_agree() {
        let d = Dimension::CHARGE.over(Dimension::VOLTAGE);
        assert_eq!(d, Dimension::CAPACITANCE);
        assert_eq!(Dimension::NONE.over(Dimension::RESISTANCE), Dimension::CONDUCTANCE);
        assert_eq!(Dimension::RESISTANCE.times(Dimension::TIME), Dimension::INDUCTANCE);
        assert_eq!(Dimension::FORCE.times(Dimension::VELOCITY), Dimension::POWER);
        assert_eq!(Dimension::STIFFNESS.times(Dimension::LENGTH), Dimension::FORCE);
        assert_eq!(Dimension::VELOCITY.power(2).times(Dimension::MASS), Dimension::ENERGY);
    }
    #[test]
    fn huge_powers_stop_at_the_end() {
        let huge = Dimension::LENGTH.power(100);
        assert_eq!(huge.times(huge), Dimension([i8::MAX, 0, 0, 0, 0, 0, 0]));
    }
    #[test]
    fn written_in_base_units() {
        assert_eq!(Dimension::NONE.to_string(), "1");
        assert_eq!(Dimension::FREQUENCY.to_string(), "1/s");
        assert_eq!(Dimension::PRESSURE.to_string(), "kg/m/s^2");
        assert_eq!(Dimension::by_name("Torque"), Some(Dimension::ENERGY));
        assert_eq!(Dimension::by_name("Colour"), None);
    }
}
