#include "sim/plant/Plant.hpp"

namespace wr::plant {

namespace {

// The purpose that selects the random numbers of the plant (see Noise).
constexpr std::uint32_t kOfPlant = 64;

// A source of random numbers. Each number is within a given range.
class Bands {
 public:
  explicit Bands(const Noise& noise) : noise_(noise) {}

  double between(double low, double high) {
    const double share = (noise_.uniform(kOfPlant, index_) + 1.0) / 2.0;
    ++index_;
    return low + share * (high - low);
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

// The ranges have these reasons. Copper that is 50 K hotter than nominal has 20 percent more
// resistance. Hot magnets lose a tenth of their field. A lead battery of 24 V has 21 V when it is
// empty, and 29 V while it is charged. The smallest mass is the mass of the robot without panels
// and sprayers. The greatest mass is the mass of the robot with a load.
Plant Plant::varied(const Noise& noise) {
  Bands bands(noise);
  Plant plant;
  plant.supply = bands.between(21.0, 29.0);
  plant.batteryResistance = bands.between(0.01, 0.08);
  plant.mass = Plant{}.mass * bands.between(0.57, 1.7);
  setInertia(plant, bands.between(0.5, 2.0));
  setRolling(plant, bands.between(0.5, 2.0));
  for (MotorParameters& motor : plant.motors) {
    motor.resistance *= bands.between(0.8, 1.25);
    motor.constant *= bands.between(0.9, 1.1);
    motor.inductance *= bands.between(0.5, 1.5);
    setFriction(motor, bands.between(0.5, 2.0));
  }
  for (CurrentSensorParameters& sensor : plant.currentSensors) {
    sensor.gain = bands.between(0.95, 1.05);
    sensor.offset = bands.between(-0.3, 0.3);
  }
  plant.angleGain = bands.between(0.98, 1.02);
  plant.angleOffset = bands.between(-0.5, 0.5);
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
