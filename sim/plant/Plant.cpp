#include "sim/plant/Plant.hpp"

namespace wr::plant {

namespace {

// The purpose that selects the random numbers of the plant (see Noise).
constexpr std::uint32_t kOfPlant = 64;

struct Range {
  double low;
  double high;
};

// The ranges have these reasons. If copper is 50 K hotter than nominal, its resistance is 20
// percent higher. Hot magnets lose a tenth of their field. A lead battery of 24 V has 21 V when it
// is empty, and 29 V while it is charged. The smallest mass is the mass of the robot without panels
// and sprayers. The greatest mass is the mass of the robot with a load.
constexpr Range kSupply{.low = 21.0, .high = 29.0};             // [V]
constexpr Range kBatteryResistance{.low = 0.01, .high = 0.08};  // [ohm]
constexpr Range kCurrentOffset{.low = -0.3, .high = 0.3};       // [A]
constexpr Range kAngleOffset{.low = -0.5, .high = 0.5};         // [degree]
// Factors of the nominal values.
constexpr Range kMass{.low = 0.57, .high = 1.7};
constexpr Range kInertia{.low = 0.5, .high = 2.0};
constexpr Range kRolling{.low = 0.5, .high = 2.0};
constexpr Range kResistance{.low = 0.8, .high = 1.25};
constexpr Range kMotorConstant{.low = 0.9, .high = 1.1};
constexpr Range kInductance{.low = 0.5, .high = 1.5};
constexpr Range kFriction{.low = 0.5, .high = 2.0};
constexpr Range kCurrentGain{.low = 0.95, .high = 1.05};
constexpr Range kAngleGain{.low = 0.98, .high = 1.02};

// A source of random numbers. Each number is within a given range.
class RandomValues {
 public:
  explicit RandomValues(const Noise& noise) : noise_(noise) {}

  double within(const Range& range) {
    const double share = (noise_.uniform(kOfPlant, index_) + 1.0) / 2.0;
    ++index_;
    return range.low + share * (range.high - range.low);
  }

 private:
  const Noise& noise_;
  std::uint64_t index_ = 0;
};

void setInertia(Plant& plant, double share) {
  constexpr MotorParameters kNominal;
  for (MotorParameters& motor : plant.motors) {
    motor.rotorInertia = share * kNominal.rotorInertia;
    motor.wheelInertia = share * kNominal.wheelInertia;
  }
  plant.yawInertia = share * Plant{}.yawInertia;
}

void setFriction(MotorParameters& motor, double share) {
  constexpr MotorParameters kNominal;
  motor.friction = share * kNominal.friction;
  motor.staticFriction = share * kNominal.staticFriction;
  motor.damping = share * kNominal.damping;
}

void setRolling(Plant& plant, double share) {
  const Plant nominal;
  plant.rollingResistance = share * nominal.rollingResistance;
  plant.staticResistance = share * nominal.staticResistance;
}

}  // namespace

Plant Plant::varied(const Noise& noise) {
  RandomValues values(noise);
  Plant plant;
  plant.supply = values.within(kSupply);
  plant.batteryResistance = values.within(kBatteryResistance);
  plant.mass = Plant{}.mass * values.within(kMass);
  setInertia(plant, values.within(kInertia));
  setRolling(plant, values.within(kRolling));
  for (MotorParameters& motor : plant.motors) {
    motor.resistance *= values.within(kResistance);
    motor.constant *= values.within(kMotorConstant);
    motor.inductance *= values.within(kInductance);
    setFriction(motor, values.within(kFriction));
  }
  for (CurrentSensorParameters& sensor : plant.currentSensors) {
    sensor.gain = values.within(kCurrentGain);
    sensor.offset = values.within(kCurrentOffset);
  }
  plant.angleGain = values.within(kAngleGain);
  plant.angleOffset = values.within(kAngleOffset);
  return plant;
}

void setParameter(Plant& plant, Parameter parameter, double value) {
  constexpr MotorParameters kNominal;
  switch (parameter) {
    case Parameter::Supply:
      plant.supply = value;
      break;
    case Parameter::Battery:
      plant.batteryResistance = value;
      break;
    case Parameter::Mass:
      plant.mass = value * Plant{}.mass;
      break;
    case Parameter::Inertia:
      setInertia(plant, value);
      break;
    case Parameter::Resistance:
      for (MotorParameters& motor : plant.motors) {
        motor.resistance = value * kNominal.resistance;
      }
      break;
    case Parameter::MotorConstant:
      for (MotorParameters& motor : plant.motors) {
        motor.constant = value * kNominal.constant;
      }
      break;
    case Parameter::Friction:
      for (MotorParameters& motor : plant.motors) {
        setFriction(motor, value);
      }
      break;
    case Parameter::Rolling:
      setRolling(plant, value);
      break;
    case Parameter::CurrentGain:
      for (CurrentSensorParameters& sensor : plant.currentSensors) {
        sensor.gain = value;
      }
      break;
    case Parameter::AngleGain:
      plant.angleGain = value;
      break;
  }
}

}  // namespace wr::plant
